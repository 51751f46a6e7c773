// mesh_part() makes the mesh of some bricks of the lattice on the device, in passes over the bricks
// (shaders/mesh_*.comp).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "blobtree/cull/lattice.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"
#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// A part's own bricks, and those around them that its mesh depends on. Each set holds the one before.
struct PartSets {
  explicit PartSets(const blobtree::BrickSet& own)
      : owned(own), placed(own.grown(1, 0)), crossed(own.grown(1, 1)), sampled(own.grown(2, 1)) {}

  blobtree::BrickSet owned;    // the part's own bricks, whose triangles are made
  blobtree::BrickSet placed;   // the bricks in which vertices of these triangles lie
  blobtree::BrickSet crossed;  // the bricks whose edges have the crossings that place these vertices
  // The bricks whose corners are sampled. There are more of them, because the patches of a cell depend on how the cells
  // beside it resolve ambiguous faces. Bricks that have neither vertices nor triangles may be left out.
  blobtree::BrickSet sampled;
};

struct PartBricks {
  blobtree::Lattice lattice;  // the lattice of the whole mesh
  // The part's own bricks in order of place; then the bricks that each larger set adds, set by set.
  blobtree::BrickList list;
  std::uint32_t owned = 0, placed = 0, crossed = 0;  // how many bricks, from the first on, are in each of these sets
};

struct PartMesh {
  MeshCells cells;   // the mesh of the part's own bricks
  MeshCells beside;  // the vertices of the other bricks in `placed`, without triangles, centres of fans and normals
};

// CANCELLED: the request was cancelled. RESOURCE_EXHAUSTED: a buffer would be larger than the device admits.
absl::StatusOr<PartMesh> mesh_part(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                                   const MeshRequest& request, PartBricks part, const MeshCallbacks& callbacks);

}  // namespace isofield::engine
