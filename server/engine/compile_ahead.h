// Has kernels compiled in the background that a scene which is being edited is likely to need next.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "blobtree/operator_table.h"
#include "blobtree/scene.h"
#include "engine/engine.h"
#include "engine/kernel_cache.h"

namespace isofield::engine {

// The likely scenes (engine/likely_edits.h) are meshed and evaluated on a device of its own, at low priority, so that
// requests wait for none of it. What the driver compiles there it keeps on disk, where the device that serves requests
// finds it. Where the driver can write to no folder, the kernels are at least specialised already.
//
// Thread-safe. The device is made when the first scene is edited.
class CompileAhead {
 public:
  // `specialised`: those of the device that serves requests.
  CompileAhead(gpu::DeviceOptions device, const blobtree::SceneLimits& limits,
               std::shared_ptr<SpecialisedKernels> specialised);
  // Waits for the kernel that is being compiled.
  ~CompileAhead();

  // A scene has been edited: of several that wait the last one counts. Returns at once.
  void edited(std::shared_ptr<const v1::Scene> scene, std::shared_ptr<const blobtree::OperatorTable> operators,
              SceneLease lease);

  // Until nothing is left to do.
  void wait();

  // Mixes of kinds that have been compiled for.
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
  std::unique_ptr<Engine> engine_;  // of the worker alone

  mutable std::mutex mutex_;
  std::condition_variable wanted_more_, is_idle_;
  std::unique_ptr<Edited> wanted_;
  std::set<Mix> seen_;  // mixes of edited scenes
  std::set<Mix> done_;  // mixes that were compiled for
  bool is_at_work_ = false, is_over_ = false;
  std::thread worker_;  // last: it uses the others
};

}  // namespace isofield::engine
