// Keeps objects that take long to make, so that they are used again instead of being destroyed. Only gpu/ uses it.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/mutex.h"

namespace isofield::gpu {

// Owns the objects that it keeps. Thread-safe.
template <class T>
class Spares {
 public:
  // Returns a kept object, or null if there is none.
  std::unique_ptr<T> take() {
    const base::MutexLock lock(mutex_);
    if (kept_.empty()) return nullptr;
    std::unique_ptr<T> last = std::move(kept_.back());
    kept_.pop_back();
    return last;
  }
  // Keeps an object, or destroys it if kMost are kept already.
  void give(std::unique_ptr<T> object) {
    const base::MutexLock lock(mutex_);
    if (kept_.size() < kMost) kept_.push_back(std::move(object));
  }

 private:
  static constexpr std::size_t kMost = 8;

  base::Mutex mutex_;
  std::vector<std::unique_ptr<T>> kept_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace isofield::gpu
