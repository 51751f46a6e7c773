// Kernels without the code that a mix of opcodes does not use. These are what drivers get to compile.
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

// Thread-safe. Several devices may share one.
class SpecialisedKernels {
 public:
  using Kernel = std::shared_ptr<const std::vector<std::uint32_t>>;
  // The most kernels kept in memory, of some 0.1 MB each.
  static constexpr std::size_t kMostInMemory = 128;

  // `folder` keeps the kernels on disk; if it is empty, nothing does.
  explicit SpecialisedKernels(const std::string& folder = {}) : store_(folder) {}

  // How many kernels have been loaded from disk or made, because they were not in memory.
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
