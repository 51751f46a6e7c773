// A pool of threads on which the host runs its own work in parallel, such as culling and sorting.
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

// Owns its threads, which end with it. Thread-safe: several threads may call for_each() at once.
class Workers {
 public:
  // Starts `threads` threads. A thread that calls for_each() works as well, so it may be 0.
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // Calls work(0) to work(count - 1), each once, on this thread and on threads of the pool that are idle, and returns
  // when all have returned. `work` must not throw.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work);
  // Returns for_each() as a function, which must not outlive this.
  ForEach for_each() {
    return [this](std::size_t count, const std::function<void(std::size_t)>& work) { for_each(count, work); };
  }

 private:
  struct Task {
    const std::function<void(std::size_t)>* work;
    std::size_t count;
    std::atomic<std::size_t> next{0};
    unsigned helpers = 0;  // threads of the pool that work on it
  };
  static void take_part(Task& task);
  void help();

  Mutex mutex_;
  Condition came_, left_;
  std::list<Task*> tasks_ ABSL_GUARDED_BY(mutex_);  // tasks with parts that may not be taken yet
  bool is_over_ ABSL_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;  // the last member, since the threads use the others
};

}  // namespace isofield::base
