// Meshes that were made, kept while their scene is resident and room is left: the same request again costs no device
// time.
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

// Thread-safe. The least recently used give way.
class MeshCache {
 public:
  using Parts = std::vector<std::shared_ptr<const MeshCells>>;
  struct Kept {
    Parts parts;
    std::optional<ShellCounts> shells;  // where they were counted
  };

  explicit MeshCache(std::uint64_t max_bytes = std::uint64_t{256} << 20) : max_bytes_(max_bytes) {}

  // Null: not kept.
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
