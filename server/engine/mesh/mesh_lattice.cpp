#include "engine/mesh/mesh_lattice.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/status_macros.h"
#include "blobtree/tape/extent.h"
#include "engine/mesh/cell_size.h"
#include "engine/mesh/mesh_rounding.h"

namespace isofield::engine {
namespace {

using blobtree::Box;
using blobtree::Brick;
using blobtree::BrickList;
using blobtree::CullRequest;
using blobtree::Lattice;

// The cells along an axis that are left for the scene, after those for the alignment and the room around derived
// bounds.
constexpr double kUsableCells = kMaxCellsPerAxis - 4 - kLatticeAlignment;

absl::Status refusal(const blobtree::Tape& tape, const MeshRequest& request, bool is_part, std::uint64_t max_bricks,
                     const std::function<bool()>& cancelled) {
  const bool is_along_axis = request.cell_size < least_cell_size(tape, request);
  const std::string what = stated_size(request);
  const std::string limit =
      is_along_axis ? absl::StrCat("the ", kMaxCellsPerAxis, " cells that are admitted along an axis")
                    : absl::StrCat("the ", max_bricks * blobtree::kCellsPerBrick, " cells that are admitted in all");
  if (is_part && !is_along_axis) {
    return absl::ResourceExhaustedError(
        absl::StrCat(what, ": the bricks of this part take more than ", limit, "; ask for fewer bricks at once"));
  }
  ISOFIELD_ASSIGN_OR_RETURN(FittingCell fits, fitting_cell(tape, request, max_bricks, cancelled));
  // An extrapolated size may be no larger than the one that is refused now.
  if (!fits.is_exact) fits.size = std::max(fits.size, 1.1 * request.cell_size);
  const char* const about = fits.is_exact ? "" : "about ";
  return absl::ResourceExhaustedError(
      request.resolution
          ? absl::StrCat(what, " takes more than ", limit, "; the largest resolution that fits is ", about,
                         std::max(std::floor(*request.resolution * request.cell_size / fits.size), 1.0))
          : absl::StrCat(what, " takes more than ", limit, "; the smallest cell size that fits is ", about, fits.size));
}

}  // namespace

std::string stated_size(const MeshRequest& request) {
  return request.resolution ? absl::StrCat("resolution = ", *request.resolution)
                            : absl::StrCat("cell_size = ", request.cell_size);
}

double least_cell_size(const blobtree::Tape& tape, const MeshRequest& request) {
  const Box b = request.bounds.value_or(tape.support);
  const double edge = blobtree::longest_edge(b);
  // A cell must be at least 4 steps of float32 long, as large as these are at the greatest distance from the origin.
  const double reach = std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.min.z), std::abs(b.max.x),
                                 std::abs(b.max.y), std::abs(b.max.z)});
  return std::max(edge, 2 * reach) / kUsableCells;
}

absl::StatusOr<BrickList> cull_surface(const blobtree::Tape& tape, const MeshRequest& request, const Lattice& lattice,
                                       const std::optional<blobtree::BrickSet>& within, std::uint64_t max_bricks,
                                       const std::function<bool()>& cancelled, const base::ForEach& for_each) {
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

absl::StatusOr<Lattice> mesh_lattice(const blobtree::Tape& tape, const MeshRequest& request) {
  const double cell = request.cell_size;
  const Box bounds = request.bounds.value_or(tape.support);
  if (cell < least_cell_size(tape, request)) return absl::ResourceExhaustedError("too many cells along an axis");
  constexpr double kAlignment = kLatticeAlignment;
  Lattice lattice;
  lattice.spacing = {cell, cell, cell};
  const auto along = [&](double low, double high, double& origin) {
    if (request.bounds) {
      origin = low;
      return static_cast<std::uint32_t>(std::max(std::ceil((high - low) / cell - 1e-9), 1.0));
    }
    // One cell of room on either side makes sure that the outermost corners are outside.
    origin = std::floor((low / cell - 1) / kAlignment) * kAlignment * cell;
    return static_cast<std::uint32_t>(std::ceil((high - origin) / cell)) + 1;
  };
  lattice.cells = {along(bounds.min.x, bounds.max.x, lattice.origin.x),
                   along(bounds.min.y, bounds.max.y, lattice.origin.y),
                   along(bounds.min.z, bounds.max.z, lattice.origin.z)};
  return lattice;
}

absl::StatusOr<SurfaceBricks> surface_bricks(const blobtree::Tape& tape, const MeshRequest& request,
                                             const std::optional<blobtree::BrickSet>& within, std::uint64_t max_bricks,
                                             const std::function<bool()>& cancelled, const base::ForEach& for_each) {
  const auto find = [&]() -> absl::StatusOr<SurfaceBricks> {
    ISOFIELD_ASSIGN_OR_RETURN(Lattice lattice, mesh_lattice(tape, request));
    if (!within) {
      ISOFIELD_ASSIGN_OR_RETURN(const bool is_refused, is_far_too_fine(tape, request, max_bricks, cancelled));
      if (is_refused) return absl::ResourceExhaustedError("far too many bricks");
    }
    ISOFIELD_ASSIGN_OR_RETURN(BrickList list,
                              cull_surface(tape, request, lattice, within, max_bricks, cancelled, for_each));
    return SurfaceBricks{lattice, std::move(list)};
  };
  absl::StatusOr<SurfaceBricks> found = find();
  if (!absl::IsResourceExhausted(found.status())) return found;
  return refusal(tape, request, within.has_value(), max_bricks, cancelled);
}

std::vector<std::uint32_t> brick_neighbours(const std::vector<Brick>& bricks) {
  // Coordinates are shifted by one, so that -1 stays in range.
  const auto key = [](std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (x + 1) | (y + 1) << 21 | (z + 1) << 42;
  };
  absl::flat_hash_map<std::uint64_t, std::uint32_t> places;
  places.reserve(bricks.size());
  for (std::uint32_t i = 0; i < bricks.size(); ++i) places.emplace(key(bricks[i].x, bricks[i].y, bricks[i].z), i);
  std::vector<std::uint32_t> neighbours(kNeighbours * bricks.size(), kNoBrick);
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    for (std::size_t n = 0; n < kNeighbours; ++n) {
      const auto& step = kNeighbourSteps[n];
      const auto it = places.find(key(bricks[i].x + step[0], bricks[i].y + step[1], bricks[i].z + step[2]));
      if (it != places.end()) neighbours[kNeighbours * i + n] = it->second;
    }
  }
  return neighbours;
}

}  // namespace isofield::engine
