#include "engine/mesh/cell_size.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/status_macros.h"
#include "blobtree/tape/extent.h"
#include "engine/mesh/mesh_lattice.h"

namespace isofield::engine {
namespace {

using blobtree::Box;
using blobtree::Leaf;
using blobtree::Tape;

// Coarse lattices have at most this many bricks, which take some milliseconds of one core in scenes of few primitives.
constexpr std::uint64_t kQuickBricks = 1u << 13;
// A cell size is refused without culling if two estimates both find this many times the bricks that are admitted.
constexpr double kFar = 1.5;
// Cells of this many times the scene's longest edge take as few bricks as is possible.
constexpr double kCoarsestOfEdge = 64;

// Returns the distance outward from the shape's own surface at which the field of its leaf is iso, in the shape's
// frame.
double offset_at(const Leaf& leaf, double iso) {
  if (leaf.law == operators::Law::kSigned) return iso / leaf.per_distance;
  const double r0 = std::sqrt(1 - std::cbrt(0.5));
  return leaf.range * (std::sqrt(1 - std::cbrt(iso)) - r0) / (1 - r0);
}

// Returns the least radius of a primitive where its field is iso, in world lengths; 0 or less if it has no surface
// there.
double least_radius(const Leaf& leaf, const Tape& tape, double iso) {
  // An operator that leads from one law to the other takes other levels of its operand than iso.
  return leaf.feature_size(leaf.law == tape.law ? offset_at(leaf, iso) : 0);
}

bool counts(const Leaf& leaf, const MeshRequest& request) {
  return !request.bounds || leaf.support.touches(*request.bounds);
}

double longest_edge(const Tape& tape, const MeshRequest& request) {
  return blobtree::longest_edge(request.bounds.value_or(tape.support));
}

// Counts the bricks that a request takes with cells of another size.
class BrickCounter {
 public:
  BrickCounter(const Tape& tape, const MeshRequest& request, const std::function<bool()>& cancelled,
               const base::ForEach& for_each = {})
      : tape_(tape), request_(request), cancelled_(cancelled), for_each_(for_each) {}

  // Returns most + 1 if there are more than `most`.
  absl::StatusOr<std::uint64_t> count(double cell_size, std::uint64_t most) {
    request_.cell_size = cell_size;
    const auto lattice = mesh_lattice(tape_, request_);
    if (!lattice.ok()) return most + 1;
    const auto list = cull_surface(tape_, request_, *lattice, std::nullopt, most, cancelled_, for_each_);
    if (absl::IsResourceExhausted(list.status())) return most + 1;
    if (!list.ok()) return list.status();
    return list->bricks.size();
  }

 private:
  const Tape& tape_;
  MeshRequest request_;
  const std::function<bool()>& cancelled_;
  const base::ForEach for_each_;
};

// The finest of the cell sizes edge / 16 * 2^(n / 2) that takes at most a given number of bricks.
struct CoarseLook {
  double cell = 0;
  double bricks = 0;  // the number of bricks at that size
  double growth = 2;  // near that size the number of bricks grows as cell^-growth
};
constexpr double kLookStep = std::numbers::sqrt2;

absl::StatusOr<CoarseLook> look_coarsely(BrickCounter& counter, double edge, std::uint64_t most) {
  CoarseLook look{.cell = edge / 16};
  ISOFIELD_ASSIGN_OR_RETURN(std::uint64_t bricks, counter.count(look.cell, most));
  bool is_finest = bricks > most;
  for (; bricks > most; look.cell *= kLookStep) {
    if (look.cell > kCoarsestOfEdge * edge) {
      return absl::ResourceExhaustedError(absl::StrCat("the surface takes more than the ",
                                                       most * blobtree::kCellsPerBrick,
                                                       " cells that are admitted, however large they are"));
    }
    ISOFIELD_ASSIGN_OR_RETURN(bricks, counter.count(look.cell * kLookStep, most));
  }
  double before = 0;
  while (!is_finest) {
    ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t more, counter.count(look.cell / kLookStep, most));
    is_finest = more > most;
    if (is_finest) break;
    look.cell /= kLookStep;
    before = static_cast<double>(bricks);
    bricks = more;
  }
  look.bricks = static_cast<double>(bricks);
  if (before > 0 && bricks > 0) look.growth = std::log(look.bricks / before) / std::log(kLookStep);
  return look;
}

// Rounds up to four digits, two more than a search to some per cent is worth.
double rounded_up(double size) {
  const double unit = std::pow(10, std::floor(std::log10(size)) - 3);
  return std::ceil(size / unit) * unit;
}

}  // namespace

std::optional<ThinPrimitives> too_thin(const Tape& tape, const MeshRequest& request) {
  ThinPrimitives thin;
  double least = std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : tape.leaves) {
    if (!counts(leaf, request)) continue;
    const double radius = least_radius(leaf, tape, request.iso);
    if (!(radius > 0 && request.cell_size > kCoarsestCellOfRadius * radius)) continue;
    ++thin.primitives;
    if (radius >= least) continue;
    least = radius;
    thin.node = leaf.node;
  }
  if (thin.primitives == 0) return std::nullopt;
  thin.thickness = 2 * least;
  thin.cell_size = kCoarsestCellOfRadius * least;
  return thin;
}

absl::StatusOr<bool> is_far_too_fine(const Tape& tape, const MeshRequest& request, std::uint64_t max_bricks,
                                     const std::function<bool()>& cancelled) {
  if (max_bricks <= kQuickBricks) return false;
  // A brick that the surface crosses holds a piece of it of two thirds of a face's area. So this estimate is low where
  // primitives lie apart. The other one, from coarse lattices, is low where primitives lie inside others.
  double area = 0;
  for (const Leaf& leaf : tape.leaves) {
    if (counts(leaf, request)) area += leaf.area();
  }
  const double brick = blobtree::kBrickCells * request.cell_size;
  if (area <= kFar * static_cast<double>(max_bricks) * brick * brick) return false;
  BrickCounter counter(tape, request, cancelled);
  ISOFIELD_ASSIGN_OR_RETURN(const CoarseLook look, look_coarsely(counter, longest_edge(tape, request), kQuickBricks));
  // A few bricks say little about how their number grows.
  if (look.bricks < kQuickBricks / 4.0) return false;
  return look.bricks * std::pow(look.cell / request.cell_size, std::min(look.growth, 2.0)) >
         kFar * static_cast<double>(max_bricks);
}

absl::StatusOr<FittingCell> fitting_cell(const Tape& tape, const MeshRequest& request, std::uint64_t max_bricks,
                                         const std::function<bool()>& cancelled) {
  BrickCounter counter(tape, request, cancelled);
  const double edge = longest_edge(tape, request);
  ISOFIELD_ASSIGN_OR_RETURN(const CoarseLook look, look_coarsely(counter, edge, std::min(max_bricks, kQuickBricks)));
  if (max_bricks > kQuickBricks) {
    // The number of bricks grows by the square in the end; it grows faster while most bricks hold several parts of the
    // surface.
    const double growth = std::clamp(look.growth, 2.0, 3.0);
    const double size = look.cell * std::pow(look.bricks / static_cast<double>(max_bricks), 1 / growth);
    return FittingCell{rounded_up(std::max(1.03 * size, least_cell_size(tape, request))), false};
  }
  double fits = look.cell, too_small = look.cell / kLookStep;
  while (fits / too_small > 1.04) {
    const double middle = std::sqrt(fits * too_small);
    ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t bricks, counter.count(middle, max_bricks));
    (bricks <= max_bricks ? fits : too_small) = middle;
  }
  return FittingCell{rounded_up(fits), true};
}

absl::StatusOr<double> automatic_cell_size(const Tape& tape, const MeshRequest& request,
                                           const std::function<bool()>& cancelled, const base::ForEach& for_each) {
  const std::uint64_t most = request.max_cells / blobtree::kCellsPerBrick;
  if (tape.support.empty()) return 1.0;
  MeshRequest wanted = request;
  wanted.cell_size = longest_edge(tape, request) / kAutomaticCellsAlong;
  for (const Leaf& leaf : tape.leaves) {
    const double radius = counts(leaf, request) ? least_radius(leaf, tape, request.iso) : 0;
    if (radius > 0) wanted.cell_size = std::min(wanted.cell_size, radius);
  }
  BrickCounter counter(tape, request, cancelled, for_each);
  ISOFIELD_ASSIGN_OR_RETURN(bool is_too_fine, is_far_too_fine(tape, wanted, most, cancelled));
  if (!is_too_fine) {
    ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t bricks, counter.count(wanted.cell_size, most));
    if (bricks <= most) return wanted.cell_size;
  }
  ISOFIELD_ASSIGN_OR_RETURN(const FittingCell fitting, fitting_cell(tape, request, most, cancelled));
  if (fitting.is_exact) return std::max(fitting.size, wanted.cell_size);
  // Search from the extrapolated size for one that is known to fit and uses most of the bricks that are admitted.
  constexpr double kWellUsed = 0.85, kAimedAt = 0.93, kNarrow = 1.04;
  const auto admitted = static_cast<double>(most);
  double too_small = wanted.cell_size, cell = std::max(fitting.size, kNarrow * too_small), fits = 0;
  for (;;) {
    cell = rounded_up(cell);
    ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t counted, counter.count(cell, most));
    const auto bricks = static_cast<double>(counted);
    if (counted > most) {
      too_small = cell;
      cell = fits > 0 ? std::sqrt(fits * too_small) : 1.15 * cell;
    } else {
      fits = cell;
      if (bricks >= kWellUsed * admitted) break;
      cell = std::max(cell * std::sqrt(bricks / (kAimedAt * admitted)), std::sqrt(kNarrow) * too_small);
    }
    if (fits > 0 && fits / too_small <= kNarrow) break;
  }
  return fits;
}

}  // namespace isofield::engine
