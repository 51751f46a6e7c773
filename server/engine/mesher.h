// Closed triangle meshes of a scene's surface, made on the device: dual contouring, with one vertex a patch of a cell,
// on the bricks that the surface may cross, so that memory and time follow the surface and not the box. Creases come
// out sharp where the crease turns by 25 degrees or more and crosses the cell that its vertex lies in.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "blobtree/lattice.h"
#include "engine/kernel_cache.h"
#include "engine/mesh_cells.h"
#include "engine/resident_scene.h"

namespace isofield::engine {

struct MeshRequest {
  double cell_size = 0;  // > 0
  // Where the surface leaves these, the mesh is capped within a cell. Absent: nothing is cut.
  std::optional<blobtree::Box> bounds;
  double iso = 0.5;  // within ]0, 1[
  bool with_normals = true;
  double tolerance = 1e-3;  // of vertices' distances from the surface, as linearised, in cells; > 0
  std::uint64_t max_cells = 1u << 25;
  // Only these bricks of the mesh, of which at least one is; the lattice is that of the whole.
  std::optional<blobtree::BrickBox> part;
};

struct MeshCallbacks {
  std::function<void(double)> progress;  // fraction within [0, 1], never decreasing
  std::function<bool()> cancelled;       // true: give up with CANCELLED
};

// Thread-safe.
class Mesher {
 public:
  Mesher(gpu::Device& device, KernelCache& kernels) : device_(device), kernels_(kernels) {}

  // Deterministic. RESOURCE_EXHAUSTED: more cells than admitted; the message states the smallest cell size that fits.
  absl::StatusOr<Mesh> mesh(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks);

  // The same by bricks, handed over in order of place as they are made; a failure of `deliver` ends the work. A brick
  // holds the same bytes whatever part it is asked with.
  using Deliver = std::function<absl::Status(MeshCells)>;
  absl::Status cells(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks,
                     const Deliver& deliver);

 private:
  gpu::Device& device_;
  KernelCache& kernels_;
};

}  // namespace isofield::engine
