// Private to this room: objects that are dear to make, kept for the next one who needs such a thing.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/mutex.h"

namespace isofield::gpu {

// Thread-safe.
template <class T>
class Spares {
 public:
  // Null: there is none.
  std::unique_ptr<T> take() {
    const base::MutexLock lock(mutex_);
    if (kept_.empty()) return nullptr;
    std::unique_ptr<T> last = std::move(kept_.back());
    kept_.pop_back();
    return last;
  }
  // Destroys it where enough are kept.
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
