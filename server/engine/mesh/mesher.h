// Closed triangle meshes of a scene's surface, made on the device: dual contouring, with one vertex a patch of a cell,
// on the bricks that the surface may cross, so that memory and time follow the surface and not the box. Creases come
// out sharp where the crease turns by 25 degrees or more and crosses the cell that its vertex lies in.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/workers.h"
#include "blobtree/cull/lattice.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/mesh/mesh_cache.h"
#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_part.h"
#include "engine/mesh/mesh_request.h"
#include "engine/residency/resident_scene.h"

namespace isofield::engine {

// Thread-safe.
class Mesher {
 public:
  Mesher(gpu::Device& device, KernelCache& kernels, base::Workers& workers)
      : device_(device), kernels_(kernels), workers_(workers) {}

  // Deterministic. RESOURCE_EXHAUSTED: as surface_bricks().
  // `shells`: where it is not null, is given those of the whole mesh; nothing where request.part asks for a part.
  absl::StatusOr<Mesh> mesh(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                            std::optional<ShellCounts>* shells = nullptr);

  // The same by bricks, handed over in order of place as they are made; a failure of `deliver` ends the work. A brick
  // holds the same bytes whatever part it is asked with.
  using Deliver = std::function<absl::Status(const MeshCells&)>;
  absl::Status cells(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                     const Deliver& deliver, std::optional<ShellCounts>* shells = nullptr);

  // automatic_cell_size(), on all threads.
  absl::StatusOr<double> automatic_cell_size(const ResidentScene& scene, const MeshRequest& request,
                                             const std::function<bool()>& cancelled) const;
  // Beyond so many cells a request is refused whatever it admits: one binding holds a word for each.
  std::uint64_t max_cells() const;

  // The bricks that `sets` states, whatever request.part says.
  absl::StatusOr<PartMesh> part(const ResidentScene& scene, const MeshRequest& request, const PartSets& sets,
                                const MeshCallbacks& callbacks);

 private:
  absl::StatusOr<SurfaceBricks> find_bricks(const ResidentScene& scene, const MeshRequest& request,
                                            const std::optional<blobtree::BrickSet>& within,
                                            const MeshCallbacks& callbacks) const;
  absl::StatusOr<MeshCache::Parts> make(const ResidentScene& scene, const MeshRequest& request,
                                        const MeshCallbacks& callbacks, const Deliver& deliver);

  gpu::Device& device_;
  KernelCache& kernels_;
  base::Workers& workers_;
  MeshCache cache_;
};

}  // namespace isofield::engine
