// WrittenKernels makes tier-two kernels: in the background, a scene that is asked often gets a kernel that is written
// for the structure of its tape. The interpreter serves all other scenes.
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
  // The number of points that are evaluated with tapes of one structure before it gets a kernel.
  std::uint64_t hot_points = 1u << 20;
  // The most kernels that are held or wanted, at least 1. Another one then takes the place of the kernel that has not
  // been used for the longest time; if none is made yet, its structure has no kernel until it is asked for again.
  std::uint64_t most_kernels = 256;
  // The folder that keeps compiled kernels; if its name is empty, they are not kept.
  std::string folder;
};

// Two tapes have the same structure if they differ only in the contents of their records. Parameters are data of a
// kernel, so that scenes of one structure share it. Owns a thread that writes and compiles kernels. Thread-safe; a
// kernel that cannot be made is counted as a failure, and its scenes stay with the interpreter.
class WrittenKernels {
 public:
  WrittenKernels(gpu::Device& device, TierTwoOptions options);
  // Waits until the kernel that is being compiled is finished.
  ~WrittenKernels();

  // Returns the work of a point in the kernel of such a tape, counted in instructions of cheap operators such as sums.
  static std::size_t work_of(const blobtree::Tape& tape);

  // Returns the kernel of shaders/tape_points.comp for the scene's whole tape, or null if there is none or none yet. It
  // never waits for a kernel. `points` is how many points are evaluated now; they count towards hot_points.
  gpu::SharedPipeline find(const ResidentScene& scene, bool with_gradient, std::uint64_t points);

  // Waits until every kernel that is wanted is made or is known to fail.
  void wait();

  struct Counts {
    std::uint64_t kernels = 0;    // how many have been made so far
    std::uint64_t from_disk = 0;  // how many of them an earlier process had compiled
    std::uint64_t failures = 0;
    std::uint64_t held = 0;  // how many exist or are wanted
  };
  Counts counts() const;

 private:
  // Identifies the structure of a tape, and whether the gradient is asked.
  using Key = std::vector<std::uint32_t>;
  struct Entry {
    std::uint64_t points = 0;
    bool is_hot = false;
    gpu::SharedPipeline kernel;
    std::uint64_t last_used = 0;  // the number of the call of find()
  };
  struct Wanted {
    Key key;
    SceneLease scene;  // a scene of this structure
    bool with_gradient;
  };

  static Key key_of(const blobtree::Tape& tape, bool with_gradient);
  void work();
  absl::StatusOr<gpu::SharedPipeline> make(const Wanted& wanted);
  absl::StatusOr<std::vector<std::uint32_t>> spirv_of(const Wanted& wanted);
  void forget_cold() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Returns false if no kernel is made yet that could be freed.
  bool forget_least_used() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  gpu::Device& device_;
  const TierTwoOptions options_;
  const SpirvStore store_;
  mutable base::Mutex mutex_;
  base::Condition wanted_more_, made_one_;
  std::map<Key, Entry> entries_ ABSL_GUARDED_BY(mutex_);
  std::uint64_t uses_ ABSL_GUARDED_BY(mutex_) = 0;  // calls of find()
  std::deque<Wanted> wanted_ ABSL_GUARDED_BY(mutex_);
  bool is_at_work_ ABSL_GUARDED_BY(mutex_) = false, is_over_ ABSL_GUARDED_BY(mutex_) = false;
  Counts counts_ ABSL_GUARDED_BY(mutex_);
  std::thread worker_;  // the last member, since it uses the others
};

}  // namespace isofield::engine
