#include "engine/mesh_lattice.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/mesh_rounding.h"
#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

using blobtree::Box;
using blobtree::Brick;
using blobtree::BrickList;
using blobtree::CullRequest;
using blobtree::dvec3;
using blobtree::Lattice;

double longest_edge(const Box& box) {
  return std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
}

using Within = std::optional<blobtree::BrickSet>;

absl::StatusOr<BrickList> cull_surface(const blobtree::Tape& tape, const MeshRequest& request, const Within& within,
                                       const Lattice& lattice, std::uint64_t max_bricks,
                                       const std::function<bool()>& cancelled, const blobtree::ForEach& for_each = {}) {
  return blobtree::cull(tape, CullRequest{.lattice = lattice,
                                          .within = within,
                                          .keep = blobtree::Keep::kSurface,
                                          .iso = request.iso,
                                          .is_capped = request.bounds.has_value(),
                                          .above = mesh_rounding(tape, lattice, request.iso).shift,
                                          .max_bricks = max_bricks,
                                          .cancelled = cancelled,
                                          .for_each = for_each});
}

// Bricks at this cell size, or max_bricks + 1 when there are more.
absl::StatusOr<std::uint64_t> count_bricks(const blobtree::Tape& tape, MeshRequest request, const Within& within,
                                           double cell_size, std::uint64_t max_bricks,
                                           const std::function<bool()>& cancelled) {
  request.cell_size = cell_size;
  const auto lattice = mesh_lattice(tape, request);
  if (!lattice.ok()) return max_bricks + 1;
  const auto list = cull_surface(tape, request, within, *lattice, max_bricks, cancelled);
  if (absl::IsResourceExhausted(list.status())) return max_bricks + 1;
  if (!list.ok()) return list.status();
  return list->bricks.size();
}

// The smallest cell size, to a few per cent, whose bricks are admitted.
absl::StatusOr<double> smallest_fitting_cell(const blobtree::Tape& tape, const MeshRequest& request,
                                             const Within& within, std::uint64_t max_bricks,
                                             const std::function<bool()>& cancelled) {
  double too_small = request.cell_size, fits = too_small;
  for (;;) {
    fits *= 2;
    const auto bricks = count_bricks(tape, request, within, fits, max_bricks, cancelled);
    if (!bricks.ok()) return bricks.status();
    if (*bricks <= max_bricks) break;
    too_small = fits;
  }
  while (fits / too_small > 1.04) {
    const double middle = std::sqrt(fits * too_small);
    const auto bricks = count_bricks(tape, request, within, middle, max_bricks, cancelled);
    if (!bricks.ok()) return bricks.status();
    (*bricks <= max_bricks ? fits : too_small) = middle;
  }
  // Two digits more than the search is worth, rounded up.
  const double unit = std::pow(10, std::floor(std::log10(fits)) - 3);
  return std::ceil(fits / unit) * unit;
}

// The least radius of a primitive, in world lengths.
double thinness(const blobtree::Leaf& leaf) {
  const blobtree::ShapeSize& s = leaf.size;
  double least = s[0];
  switch (leaf.shape) {
    case blobtree::Shape::kSphere:
      break;
    case blobtree::Shape::kSegment:
      least = std::min(s[1], s[2]);
      break;
    case blobtree::Shape::kCylinder:
      least = std::min(s[0], s[1]);
      break;
    case blobtree::Shape::kTorus:
      least = s[1];
      break;
    case blobtree::Shape::kBox:
    case blobtree::Shape::kEllipsoid:
      least = std::min({s[0], s[1], s[2]});
      break;
  }
  return least / leaf.stretch;
}

}  // namespace

absl::StatusOr<Lattice> mesh_lattice(const blobtree::Tape& tape, const MeshRequest& request) {
  const double cell = request.cell_size;
  const Box bounds = request.bounds.value_or(tape.support);
  // Far from the origin float32 tells points apart no better than at that distance: a cell is 4 such steps at least.
  const double reach = std::max({std::abs(bounds.min.x), std::abs(bounds.min.y), std::abs(bounds.min.z),
                                 std::abs(bounds.max.x), std::abs(bounds.max.y), std::abs(bounds.max.z)});
  if (std::max(longest_edge(bounds), 2 * reach) / cell > kMaxCellsPerAxis - 4 - kLatticeAlignment) {
    return absl::ResourceExhaustedError("too many cells along an axis");
  }
  constexpr double kAlignment = kLatticeAlignment;
  Lattice lattice;
  lattice.spacing = {cell, cell, cell};
  const auto along = [&](double low, double high, double& origin) {
    if (request.bounds) {
      origin = low;
      return static_cast<std::uint32_t>(std::max(std::ceil((high - low) / cell - 1e-9), 1.0));
    }
    // One cell of room on either side: the outermost corners are outside.
    origin = std::floor((low / cell - 1) / kAlignment) * kAlignment * cell;
    return static_cast<std::uint32_t>(std::ceil((high - origin) / cell)) + 1;
  };
  lattice.cells = {along(bounds.min.x, bounds.max.x, lattice.origin.x),
                   along(bounds.min.y, bounds.max.y, lattice.origin.y),
                   along(bounds.min.z, bounds.max.z, lattice.origin.z)};
  return lattice;
}

absl::StatusOr<double> automatic_cell_size(const blobtree::Tape& tape, const MeshRequest& request) {
  const std::uint64_t most = std::min(kAutomaticCells, request.max_cells) / blobtree::kCellsPerBrick;
  if (tape.support.empty()) return 1.0;
  double cell = longest_edge(request.bounds.value_or(tape.support)) / kAutomaticCellsAlong;
  for (const blobtree::Leaf& leaf : tape.leaves) cell = std::min(cell, thinness(leaf));
  for (;; cell *= 1.25) {
    const auto bricks = count_bricks(tape, request, std::nullopt, cell, most, {});
    if (!bricks.ok()) return bricks.status();
    if (*bricks <= most) return cell;
  }
}

absl::StatusOr<SurfaceBricks> surface_bricks(const blobtree::Tape& tape, const MeshRequest& request,
                                             const std::optional<blobtree::BrickSet>& within, std::uint64_t max_bricks,
                                             const std::function<bool()>& cancelled,
                                             const blobtree::ForEach& for_each) {
  const auto find = [&]() -> absl::StatusOr<SurfaceBricks> {
    ISOFIELD_ASSIGN_OR_RETURN(Lattice lattice, mesh_lattice(tape, request));
    ISOFIELD_ASSIGN_OR_RETURN(BrickList list,
                              cull_surface(tape, request, within, lattice, max_bricks, cancelled, for_each));
    return SurfaceBricks{lattice, std::move(list)};
  };
  absl::StatusOr<SurfaceBricks> found = find();
  if (!absl::IsResourceExhausted(found.status())) return found;
  ISOFIELD_ASSIGN_OR_RETURN(const double fits, smallest_fitting_cell(tape, request, within, max_bricks, cancelled));
  return absl::ResourceExhaustedError(absl::StrCat("cell_size = ", request.cell_size, " takes more cells than the ",
                                                   max_bricks * blobtree::kCellsPerBrick, " in all, or the ",
                                                   kMaxCellsPerAxis,
                                                   " along an axis, that are admitted; the smallest cell size that "
                                                   "fits is ",
                                                   fits));
}

std::vector<std::uint32_t> brick_neighbours(const std::vector<Brick>& bricks) {
  // Shifted by one so that -1 stays in range.
  const auto key = [](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (x + 1) | (y + 1) << 21 | (z + 1) << 42;
  };
  constexpr std::array<std::array<int, 3>, kNeighbours> kSteps{{{-1, 0, 0},
                                                                {1, 0, 0},
                                                                {0, -1, 0},
                                                                {0, 1, 0},
                                                                {0, 0, -1},
                                                                {0, 0, 1},
                                                                {0, -1, -1},
                                                                {-1, 0, -1},
                                                                {-1, -1, 0},
                                                                {0, 1, 1},
                                                                {1, 0, 1},
                                                                {1, 1, 0}}};
  absl::flat_hash_map<std::uint64_t, std::uint32_t> places;
  places.reserve(bricks.size());
  for (std::uint32_t i = 0; i < bricks.size(); ++i) places.emplace(key(bricks[i].x, bricks[i].y, bricks[i].z), i);
  std::vector<std::uint32_t> neighbours(kNeighbours * bricks.size(), ~0u);
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    for (std::size_t n = 0; n < kNeighbours; ++n) {
      const auto it =
          places.find(key(bricks[i].x + kSteps[n][0], bricks[i].y + kSteps[n][1], bricks[i].z + kSteps[n][2]));
      if (it != places.end()) neighbours[kNeighbours * i + n] = it->second;
    }
  }
  return neighbours;
}

}  // namespace isofield::engine
