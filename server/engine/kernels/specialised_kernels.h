// Makes specialised kernels, and keeps them in memory and on disk: SPIR-V without the code that a mix of opcodes does
// not use, which is what the driver is given to compile.
#pragma once

#include <absl/status/statusor.h>

#include <atomic>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "engine/kernels/spirv_store.h"
#include "shaders/embedded.h"

namespace isofield::engine {

// Thread-safe. Several devices may share one object, because SPIR-V does not depend on the device.
class SpecialisedKernels {
 public:
  using Kernel = std::shared_ptr<const std::vector<std::uint32_t>>;
  // The most kernels kept in memory, of some 0.1 MB each.
  static constexpr std::size_t kMostInMemory = 128;

  // `folder` keeps the kernels on disk; if its name is empty, they are kept in memory alone.
  explicit SpecialisedKernels(const std::string& folder = {}) : store_(folder) {}

  // Returns how many kernels were not in memory when they were asked for, and so were loaded from disk or made.
  std::uint64_t made() const { return made_; }

  absl::StatusOr<Kernel> get(const shaders::Spirv& shader, std::span<const std::uint32_t> constants);

 private:
  using Key = std::pair<const std::uint32_t*, std::vector<std::uint32_t>>;
  struct Place {
    Key key;
    Kernel kernel;
  };

  const SpirvStore store_;
  std::atomic<std::uint64_t> made_ = 0;
  base::Mutex mutex_;
  std::list<Place> places_ ABSL_GUARDED_BY(mutex_);  // the most recently used first
  std::map<Key, std::list<Place>::iterator> by_key_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::engine
