// Mesher makes closed triangle meshes of a scene's surface on the device, by dual contouring with one vertex for each
// patch, which is a connected piece of the surface within a cell. It works only on the bricks that the surface may
// cross, so that memory and time follow the surface and not the box. A crease comes out sharp if it turns by 25 degrees
// or more and crosses the cell that its vertex lies in.
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

// Thread-safe. Owns a cache of meshes. Its functions return CANCELLED if callbacks.cancelled returns true.
class Mesher {
 public:
  Mesher(gpu::Device& device, KernelCache& kernels, base::Workers& workers)
      : device_(device), kernels_(kernels), workers_(workers) {}

  // Returns the mesh of a request; the same request gives the same bytes. RESOURCE_EXHAUSTED: as for surface_bricks(),
  // or a buffer would be too large. If `shells` is not null, it receives the numbers of bodies and voids, or nothing if
  // the request asks for a part.
  absl::StatusOr<Mesh> mesh(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                            std::optional<ShellCounts>* shells = nullptr);

  // Makes the same mesh by bricks, and hands them to `deliver` in order of place. A failure of `deliver` ends the work.
  // A brick has the same bytes whatever part it is made with.
  using Deliver = std::function<absl::Status(const MeshCells&)>;
  absl::Status cells(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                     const Deliver& deliver, std::optional<ShellCounts>* shells = nullptr);

  // Calls automatic_cell_size() of cell_size.h, on all threads.
  absl::StatusOr<double> automatic_cell_size(const ResidentScene& scene, const MeshRequest& request,
                                             const std::function<bool()>& cancelled) const;
  // Returns the most cells of any request, whatever request.max_cells says: one binding holds a word for each cell.
  std::uint64_t max_cells() const;

  // Makes the bricks that `sets` states, whatever request.part says.
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
