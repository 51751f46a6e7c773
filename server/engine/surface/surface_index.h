// Where the surface of a resident scene lies: the bricks that it may cross, ready to be walked by rays.
#pragma once

#include <absl/status/statusor.h>

#include <functional>
#include <memory>
#include <optional>

#include "base/mutex.h"
#include "blobtree/cull/brick_tree.h"
#include "engine/residency/scene_entries.h"

namespace isofield::engine {

// The surface f = iso, looked at on a lattice of cells as a mesh of it is.
struct SurfaceRequest {
  double iso = 0.5;
  // Edge length of a cell. Absent: automatic_cell_size().
  std::optional<double> cell_size;
  // Absent: nothing is cut.
  std::optional<blobtree::Box> bounds;
  std::uint64_t max_cells = 1u << 25;

  bool operator==(const SurfaceRequest&) const = default;
};

struct SurfaceIndex {
  double cell_size = 0;
  blobtree::Box box;  // of the lattice; of the bounds where they are stated
  blobtree::BrickTree tree;
};

// Keeps the indices that were used last. Thread-safe; two threads that want the same new one may both make it.
class SurfaceIndexCache {
 public:
  // RESOURCE_EXHAUSTED: as surface_bricks().
  absl::StatusOr<std::shared_ptr<const SurfaceIndex>> get(const SceneLease& scene, const SurfaceRequest& request,
                                                          const std::function<bool()>& cancelled);

 private:
  struct Entry {
    std::weak_ptr<const ResidentScene> scene;
    SurfaceRequest request;
    std::shared_ptr<const SurfaceIndex> index;
  };
  std::shared_ptr<const SurfaceIndex> find(const SceneLease& scene, const SurfaceRequest& request);
  void keep(Entry entry);

  base::Mutex mutex_;
  SceneEntries<Entry> entries_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::engine
