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
};

struct MeshCallbacks {
  std::function<void(double)> progress;  // fraction within [0, 1], never decreasing
  std::function<bool()> cancelled;       // true: give up with CANCELLED
};

struct Mesh {
  std::vector<float> positions, normals;  // 3 a vertex
  std::vector<std::uint32_t> triangles;   // 3 a triangle, counter-clockwise from outside
  std::uint64_t cells = 0;                // looked at
};

// Thread-safe.
class Mesher {
 public:
  Mesher(gpu::Device& device, KernelCache& kernels) : device_(device), kernels_(kernels) {}

  // Deterministic. RESOURCE_EXHAUSTED: more cells than admitted; the message states the smallest cell size that fits.
  absl::StatusOr<Mesh> mesh(const ResidentScene& scene, const MeshRequest& request, const MeshCallbacks& callbacks);

 private:
  gpu::Device& device_;
  KernelCache& kernels_;
};

}  // namespace isofield::engine
