// Meshes a part of the lattice on the device, in passes over its bricks (shaders/mesh_*.comp).
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "blobtree/lattice.h"
#include "engine/kernel_cache.h"
#include "engine/mesh_cells.h"
#include "engine/mesh_request.h"
#include "engine/resident_scene.h"

namespace isofield::engine {

// Bricks around a part that its mesh depends on. The numbers that its triangles give to vertices of the bricks beside
// it depend on how those resolve their ambiguous faces, and so on one brick more.
inline constexpr std::uint32_t kHaloBricks = 2;

struct PartBricks {
  blobtree::Lattice lattice;  // of the whole mesh
  // The part's own bricks in order of place, then those beside it, then those beside these.
  blobtree::BrickList list;
  std::uint32_t owned = 0;  // the part's own
  std::uint32_t inner = 0;  // and those beside it
};

absl::StatusOr<MeshCells> mesh_part(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                                    const MeshRequest& request, PartBricks part, const MeshCallbacks& callbacks);

}  // namespace isofield::engine
