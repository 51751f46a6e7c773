// A SurfaceIndex says where the surface of a resident scene may lie: it is a tree of the bricks that the surface may
// cross, ready to be walked by rays.
#pragma once

#include <absl/status/statusor.h>

#include <functional>
#include <memory>
#include <optional>

#include "base/mutex.h"
#include "blobtree/cull/brick_tree.h"
#include "engine/residency/scene_entries.h"

namespace isofield::engine {

// The surface f = iso, and the lattice of cells on which it is looked for, as for a mesh.
struct SurfaceRequest {
  double iso = 0.5;
  // Edge length of a cell, in model units. If absent, it is automatic_cell_size().
  std::optional<double> cell_size;
  // Only the surface within these bounds counts. If absent, all of it counts.
  std::optional<blobtree::Box> bounds;
  std::uint64_t max_cells = 1u << 25;

  bool operator==(const SurfaceRequest&) const = default;
};

struct SurfaceIndex {
  double cell_size = 0;
  blobtree::Box box;  // the stated bounds, or else the box of the lattice
  blobtree::BrickTree tree;
};

// Keeps the indices that were used most recently. Thread-safe; two threads that want the same new index may both make
// it.
class SurfaceIndexCache {
 public:
  // Returns the index, and makes it if need be. RESOURCE_EXHAUSTED: as for surface_bricks().
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
