// MeshCache keeps meshes while their scene is resident and there is room, so that the same request costs no device time
// when it comes again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"
#include "engine/mesh/mesh_shells.h"
#include "engine/residency/scene_entries.h"

namespace isofield::engine {

// Thread-safe. The least recently used meshes give way to new ones.
class MeshCache {
 public:
  using Parts = std::vector<std::shared_ptr<const MeshCells>>;
  struct Kept {
    Parts parts;
    std::optional<ShellCounts> shells;  // absent if they were not counted
  };

  explicit MeshCache(std::uint64_t max_bytes = std::uint64_t{256} << 20) : max_bytes_(max_bytes) {}

  // Returns null if the mesh is not kept.
  std::shared_ptr<const Kept> find(const ResidentScene& scene, const MeshRequest& request);
  void keep(const ResidentScene& scene, const MeshRequest& request, Kept mesh);

 private:
  struct Entry {
    std::weak_ptr<const ResidentScene> scene;
    MeshRequest request;
    std::shared_ptr<const Kept> mesh;
    std::uint64_t bytes;
  };
  const std::uint64_t max_bytes_;
  base::Mutex mutex_;
  SceneEntries<Entry> entries_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::engine
