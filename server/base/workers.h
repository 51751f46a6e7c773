// The host's threads, for work of its own that is worth spreading.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <list>
#include <thread>
#include <vector>

#include "base/for_each.h"
#include "base/mutex.h"

namespace isofield::base {

// Thread-safe.
class Workers {
 public:
  // So many beside those that ask.
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // Calls work(0) to work(count - 1), each once, on this thread and on those that have nothing to do; returns when all
  // have returned. `work` throws nothing.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work);
  ForEach for_each() {
    return [this](std::size_t count, const std::function<void(std::size_t)>& work) { for_each(count, work); };
  }

 private:
  struct Task {
    const std::function<void(std::size_t)>* work;
    std::size_t count;
    std::atomic<std::size_t> next{0};
    unsigned helpers = 0;  // threads of this at it
  };
  static void take_part(Task& task);
  void help();

  Mutex mutex_;
  Condition came_, left_;
  std::list<Task*> tasks_ ABSL_GUARDED_BY(mutex_);  // of which something may be left to take
  bool is_over_ ABSL_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;  // last: they use the others
};

}  // namespace isofield::base
