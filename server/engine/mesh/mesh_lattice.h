// The lattice of cells that a mesh request looks at, and its bricks.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "blobtree/cull/lattice.h"
#include "engine/mesh/mesh_layout.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// Cells along an axis: float32 numbers lattice points exactly up to here and beyond.
inline constexpr std::uint32_t kMaxCellsPerAxis = 1u << 22;

// Derived bounds begin at a multiple of so many cells, so that a scene that grows a little keeps its lattice; stated
// bounds start the lattice at their corner.
inline constexpr std::uint32_t kLatticeAlignment = 32;
absl::StatusOr<blobtree::Lattice> mesh_lattice(const blobtree::Tape& tape, const MeshRequest& request);

// No cell that is smaller is admitted: kMaxCellsPerAxis, and coordinates that float32 tells apart.
double least_cell_size(const blobtree::Tape& tape, const MeshRequest& request);

// The bricks of a lattice that the surface may cross, all or `within` some.
absl::StatusOr<blobtree::BrickList> cull_surface(const blobtree::Tape& tape, const MeshRequest& request,
                                                 const blobtree::Lattice& lattice,
                                                 const std::optional<blobtree::BrickSet>& within,
                                                 std::uint64_t max_bricks, const std::function<bool()>& cancelled,
                                                 const base::ForEach& for_each = {});

// The lattice with the bricks that the surface may cross, all or `within` some, found by `for_each`.
// RESOURCE_EXHAUSTED: more than max_bricks; the message speaks of cell_size, or of resolution where the request stated
// that, and states the smallest cell size or the largest resolution that fits, or asks for fewer bricks where `within`
// holds too many.
struct SurfaceBricks {
  blobtree::Lattice lattice;
  blobtree::BrickList list;
};
absl::StatusOr<SurfaceBricks> surface_bricks(const blobtree::Tape& tape, const MeshRequest& request,
                                             const std::optional<blobtree::BrickSet>& within, std::uint64_t max_bricks,
                                             const std::function<bool()>& cancelled,
                                             const base::ForEach& for_each = {});

// For each brick the places of its neighbours by kNeighbourSteps, or kNoBrick.
std::vector<std::uint32_t> brick_neighbours(const std::vector<blobtree::Brick>& bricks);

}  // namespace isofield::engine
