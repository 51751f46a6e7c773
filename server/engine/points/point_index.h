// A PointIndex holds a scene's bricks and their pruned tapes on the device, so that batches of points can be sorted by
// brick without pruning tapes for each batch.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/mutex.h"
#include "blobtree/cull/point_grid.h"
#include "engine/residency/scene_entries.h"
#include "engine/residency/tape_windows.h"

namespace isofield::engine {

// Immutable; any number of threads may use it. The scene must outlive it.
class PointIndex {
 public:
  // Errors are those of blobtree::PointGrid::make() and of the device.
  static absl::StatusOr<std::shared_ptr<const PointIndex>> make(gpu::Device& device, const ResidentScene& scene,
                                                                const std::function<bool()>& cancelled);

  struct Tape {
    std::uint32_t begin, count, window;  // as TapeWindows::add gives them
  };
  const blobtree::PointGrid& grid() const { return grid_; }
  // One tape for each brick of the grid.
  const std::vector<Tape>& tapes() const { return tapes_; }
  const TapeWindows& windows() const { return windows_; }
  std::size_t instructions() const { return instructions_; }  // the sum over all tapes

 private:
  PointIndex(gpu::Device& device, const ResidentScene& scene, blobtree::PointGrid grid, blobtree::BrickList bricks);

  blobtree::PointGrid grid_;
  std::size_t instructions_;
  TapeWindows windows_;
  std::vector<Tape> tapes_;
};

// Keeps the indices of scenes that many points are asked of. Thread-safe.
class PointIndexCache {
 public:
  // Returns the scene's index, and makes it if need be. Null: the batch had better be sorted by itself, because few
  // points have been asked of the scene or are in the batch, or because the scene has no index. `points` is how many
  // are evaluated now. `may_make` must be false for callers that hold a turn at the device. CANCELLED is the only
  // error.
  absl::StatusOr<std::shared_ptr<const PointIndex>> find(gpu::Device& device, const ResidentScene& scene,
                                                         std::uint64_t points, bool may_make,
                                                         const std::function<bool()>& cancelled);

 private:
  struct Entry {
    std::weak_ptr<const ResidentScene> scene;
    std::uint64_t points = 0;
    bool is_tried = false;
    std::shared_ptr<const PointIndex> index;
  };
  Entry& entry(const ResidentScene& scene) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void trim() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  base::Mutex mutex_;
  SceneEntries<Entry> entries_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::engine
