// Meshes a part of the lattice on the device, in passes over its bricks (shaders/mesh_*.comp).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "blobtree/cull/lattice.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"
#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// The bricks around a part's own that its mesh depends on; each set holds the one before.
struct PartSets {
  explicit PartSets(const blobtree::BrickSet& own)
      : owned(own), placed(own.grown(1, 0)), crossed(own.grown(1, 1)), sampled(own.grown(2, 1)) {}

  blobtree::BrickSet owned;    // have triangles,
  blobtree::BrickSet placed;   // the vertices of which lie in these,
  blobtree::BrickSet crossed;  // and are placed by crossings of edges that belong to these.
  blobtree::BrickSet sampled;  // Which patches a cell has depends on how those beside it resolve ambiguous faces.
                               // Bricks that have neither vertices nor triangles may be left out.
};

struct PartBricks {
  blobtree::Lattice lattice;  // of the whole mesh
  // The part's own bricks in order of place, then those that are in the next larger set alone, and so on.
  blobtree::BrickList list;
  std::uint32_t owned = 0, placed = 0, crossed = 0;  // so many of them are in these sets
};

struct PartMesh {
  MeshCells cells;   // of the part's own bricks
  MeshCells beside;  // of those that are placed, too: vertices of cells, without normals
};

absl::StatusOr<PartMesh> mesh_part(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                                   const MeshRequest& request, PartBricks part, const MeshCallbacks& callbacks);

}  // namespace isofield::engine
