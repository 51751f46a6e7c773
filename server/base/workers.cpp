#include "base/workers.h"

namespace isofield::base {

Workers::Workers(unsigned threads) {
  threads_.reserve(threads);
  for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { help(); });
}

Workers::~Workers() {
  {
    const MutexLock lock(mutex_);
    is_over_ = true;
  }
  came_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Workers::take_part(Task& task) {
  for (std::size_t i = task.next++; i < task.count; i = task.next++) (*task.work)(i);
}

void Workers::for_each(std::size_t count, const std::function<void(std::size_t)>& work) {
  Task task{&work, count};
  if (threads_.empty() || count < 2) return take_part(task);
  {
    const MutexLock lock(mutex_);
    tasks_.push_back(&task);
  }
  came_.notify_all();
  take_part(task);
  MutexLock lock(mutex_);
  tasks_.remove(&task);
  while (task.helpers != 0) left_.wait(mutex_);
}

void Workers::help() {
  MutexLock lock(mutex_);
  for (;;) {
    while (!is_over_ && tasks_.empty()) came_.wait(mutex_);
    if (is_over_) return;
    Task& task = *tasks_.front();
    ++task.helpers;
    lock.unlock();
    take_part(task);
    lock.lock();
    tasks_.remove(&task);
    // The task belongs to the thread that called for_each(). Once the count is 0 and the lock is released, that thread
    // may return and destroy it.
    if (--task.helpers == 0) left_.notify_all();
  }
}

}  // namespace isofield::base
