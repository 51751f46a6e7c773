// Compiles kernels in the background that an edited scene is likely to need next.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "engine/engine.h"
#include "engine/kernels/kernel_cache.h"

namespace isofield::engine {

// It meshes and evaluates the likely scenes (engine/likely_edits.h) on a second device that it owns, on a thread of low
// priority, so that no request waits for this. The driver keeps what it compiles there on disk, where the device that
// serves requests finds it. If the driver has no folder to write to, the kernels are at least specialised already.
//
// Thread-safe. It creates the device when the first scene is edited. It reports no errors: a request that needs the
// same kernel meets the error itself.
class CompileAhead {
 public:
  // `specialised` has the specialised kernels of the device that serves requests.
  CompileAhead(gpu::DeviceOptions device, const blobtree::SceneLimits& limits,
               std::shared_ptr<SpecialisedKernels> specialised);
  // Waits until the kernel that is being compiled is finished.
  ~CompileAhead();

  // Tells that a scene has been edited, and returns at once. If several scenes wait, only the last one is worked on.
  void edited(std::shared_ptr<const v1::Scene> scene, std::shared_ptr<const blobtree::OperatorTable> operators,
              SceneLease lease);

  // Waits until nothing is left to do.
  void wait();

  // A mix is what a tape's kernels are specialised to. Returns the number of mixes that have been compiled ahead.
  std::uint64_t mixes() const;

 private:
  using Mix = std::vector<std::uint32_t>;
  struct Edited {
    std::shared_ptr<const v1::Scene> scene;
    std::shared_ptr<const blobtree::OperatorTable> operators;
    SceneLease lease;
  };

  static Mix mix_of(const blobtree::Tape& tape);
  void work();
  void compile_for(const Edited& edited);
  void rehearse(const SceneLease& scene);
  bool is_over() const;

  const gpu::DeviceOptions device_;
  const blobtree::SceneLimits limits_;
  const std::shared_ptr<SpecialisedKernels> specialised_;
  std::unique_ptr<Engine> engine_;  // used by the worker alone

  mutable base::Mutex mutex_;
  base::Condition wanted_more_, is_idle_;
  std::unique_ptr<Edited> wanted_ ABSL_GUARDED_BY(mutex_);
  std::set<Mix> seen_ ABSL_GUARDED_BY(mutex_);  // mixes of edited scenes
  std::set<Mix> done_ ABSL_GUARDED_BY(mutex_);  // mixes whose kernels are compiled
  bool is_at_work_ ABSL_GUARDED_BY(mutex_) = false, is_over_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread worker_;  // the last member, since it uses the others
};

}  // namespace isofield::engine
