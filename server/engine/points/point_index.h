// The tapes of a resident scene's bricks, on the device, for the batches of points that are asked of it.
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

// Immutable. The scene outlives it.
class PointIndex {
 public:
  static absl::StatusOr<std::shared_ptr<const PointIndex>> make(gpu::Device& device, const ResidentScene& scene,
                                                                const std::function<bool()>& cancelled);

  struct Tape {
    std::uint32_t begin, count, window;  // as of TapeWindows::add
  };
  const blobtree::PointGrid& grid() const { return grid_; }
  // Of the grid's bricks.
  const std::vector<Tape>& tapes() const { return tapes_; }
  const TapeWindows& windows() const { return windows_; }
  std::size_t instructions() const { return instructions_; }  // of all tapes

 private:
  PointIndex(gpu::Device& device, const ResidentScene& scene, blobtree::PointGrid grid, blobtree::BrickList bricks);

  blobtree::PointGrid grid_;
  std::size_t instructions_;
  TapeWindows windows_;
  std::vector<Tape> tapes_;
};

// Keeps the indices of the scenes that are asked most. Thread-safe.
class PointIndexCache {
 public:
  // Null: the batch had better be sorted by itself, since few points have been asked of the scene or are in the batch,
  // or the scene has no index. `points`: how many are to be evaluated now. `may_make`: false for those who hold a turn
  // at the device.
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
