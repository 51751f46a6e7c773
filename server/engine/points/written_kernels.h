// Tier two: kernels written for one structure of tapes each, made in the background for those that are asked often.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "engine/kernels/kernel_cache.h"
#include "engine/kernels/spirv_store.h"
#include "engine/residency/resident_scene.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"

namespace isofield::engine {

struct TierTwoOptions {
  bool is_on = true;
  // How many points of a structure are evaluated before it gets a kernel.
  std::uint64_t hot_points = 1u << 20;
  // The folder that keeps compiled kernels; if it is empty, nothing does.
  std::string folder;
};

// Kernels that are written for the structure of a tape. Two tapes have the same structure where they differ only in the
// contents of their records: parameters are data, so that scenes share kernels. Thread-safe.
class WrittenKernels {
 public:
  WrittenKernels(gpu::Device& device, TierTwoOptions options);
  // Waits until the kernel that is being compiled is finished.
  ~WrittenKernels();

  // The work of a point in the kernel of such a tape, in instructions of cheap operators such as sums.
  static std::size_t work_of(const blobtree::Tape& tape);

  // The kernel of shaders/tape_points.comp for the scene's whole tape, or null where there is none, not yet, or never.
  // Never waits for one. `points`: how many will be evaluated now.
  gpu::SharedPipeline find(const ResidentScene& scene, bool with_gradient, std::uint64_t points);

  // Waits until every structure that has reached hot_points has its kernel, or is known to get none.
  void wait();

  struct Counts {
    std::uint64_t kernels = 0;    // made so far
    std::uint64_t from_disk = 0;  // of these, those that were compiled by an earlier process
    std::uint64_t failures = 0;
  };
  Counts counts() const;

 private:
  // The structure of a tape, with the quantity that is asked.
  using Key = std::vector<std::uint32_t>;
  struct Entry {
    std::uint64_t points = 0;
    bool is_hot = false;
    gpu::SharedPipeline kernel;
    std::uint64_t last_used = 0;  // in calls of find()
  };
  struct Wanted {
    Key key;
    SceneLease scene;  // one of the structure
    bool with_gradient;
  };

  static Key key_of(const blobtree::Tape& tape, bool with_gradient);
  void work();
  absl::StatusOr<gpu::SharedPipeline> make(const Wanted& wanted);
  absl::StatusOr<std::vector<std::uint32_t>> spirv_of(const Wanted& wanted);
  void forget_cold() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void forget_least_used() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  gpu::Device& device_;
  const TierTwoOptions options_;
  const SpirvStore store_;
  mutable base::Mutex mutex_;
  base::Condition wanted_more_, made_one_;
  std::map<Key, Entry> entries_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t uses_ ABSL_GUARDED_BY(mutex_) = 0, held_ ABSL_GUARDED_BY(mutex_) =
                                                       0;  // calls of find(), kernels that are there or wanted
  std::deque<Wanted> wanted_ ABSL_GUARDED_BY(mutex_);
  bool is_at_work_ ABSL_GUARDED_BY(mutex_) = false, is_over_ ABSL_GUARDED_BY(mutex_) = false;
  Counts counts_ ABSL_GUARDED_BY(mutex_);
  std::thread worker_;  // last: it uses the others
};

}  // namespace isofield::engine
