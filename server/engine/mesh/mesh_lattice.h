// Finds the lattice of cells for a mesh request, and the bricks of it that the surface may cross.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/mesh/mesh_layout.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// The most cells along an axis; float32 holds the numbers of all lattice points up to here exactly.
inline constexpr std::uint32_t kMaxCellsPerAxis = 1u << 22;

// If the bounds are derived from the scene, the lattice begins at a multiple of this many cells, so that a scene that
// grows a little keeps its lattice. If the request states bounds, the lattice begins at their corner.
inline constexpr std::uint32_t kLatticeAlignment = 32;
// Returns the lattice of a request. RESOURCE_EXHAUSTED: request.cell_size is below least_cell_size().
absl::StatusOr<blobtree::Lattice> mesh_lattice(const blobtree::Tape& tape, const MeshRequest& request);

// Returns what the client has stated, as messages of errors name it: "resolution = 64" or "cell_size = 0.1".
std::string stated_size(const MeshRequest& request);

// Returns the least cell size that is admitted, in model units. It follows from kMaxCellsPerAxis, and from the
// coordinates that float32 can tell apart.
double least_cell_size(const blobtree::Tape& tape, const MeshRequest& request);

// Returns the bricks of a lattice that the surface may cross, all of them or those in `within`. Errors are those of
// blobtree::cull().
absl::StatusOr<blobtree::BrickList> cull_surface(const blobtree::Tape& tape, const MeshRequest& request,
                                                 const blobtree::Lattice& lattice,
                                                 const std::optional<blobtree::BrickSet>& within,
                                                 std::uint64_t max_bricks, const std::function<bool()>& cancelled,
                                                 const base::ForEach& for_each = {});

// Returns the lattice and the bricks that the surface may cross, all of them or those in `within`. `for_each` runs the
// search on several threads. RESOURCE_EXHAUSTED: there are more than max_bricks, or more cells along an axis than
// kMaxCellsPerAxis. The message states the smallest cell size that fits, or the largest resolution if the request
// states a resolution; if `within` holds too many bricks, it asks for fewer bricks.
struct SurfaceBricks {
  blobtree::Lattice lattice;
  blobtree::BrickList list;
};
absl::StatusOr<SurfaceBricks> surface_bricks(const blobtree::Tape& tape, const MeshRequest& request,
                                             const std::optional<blobtree::BrickSet>& within, std::uint64_t max_bricks,
                                             const std::function<bool()>& cancelled,
                                             const base::ForEach& for_each = {});

// Returns, for each brick, the places of its kNeighbours neighbours in the order of kNeighbourSteps, or kNoBrick.
std::vector<std::uint32_t> brick_neighbours(const std::vector<blobtree::Brick>& bricks);

}  // namespace isofield::engine
