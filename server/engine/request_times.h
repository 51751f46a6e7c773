// Measures how long a request waits for its turn at the device and for kernels, and how long the device works for it.
#pragma once

#include <atomic>
#include <chrono>

namespace isofield::engine {

// Thread-safe: the parts of one request may run on several threads.
class RequestTimes {
 public:
  using Duration = std::chrono::nanoseconds;

  void add_queued(Duration d) { queued_ += d.count(); }
  void add_on_device(Duration d) { on_device_ += d.count(); }
  void add_compiling(Duration d) { compiling_ += d.count(); }
  Duration compiling() const { return Duration(compiling_); }
  Duration queued() const { return Duration(queued_); }
  Duration on_device() const { return Duration(on_device_); }

 private:
  std::atomic<Duration::rep> queued_ = 0, compiling_ = 0, on_device_ = 0;
};

// While it lives, the waiting times of sessions on this thread are added to `times`. Scopes may be nested; then only
// the innermost one counts.
class TimedScope {
 public:
  explicit TimedScope(RequestTimes& times) : outer_(current_) { current_ = &times; }
  ~TimedScope() { current_ = outer_; }
  TimedScope(const TimedScope&) = delete;
  TimedScope& operator=(const TimedScope&) = delete;

  // Returns the times of the innermost scope of this thread, or null if there is none.
  static RequestTimes* current() { return current_; }

 private:
  static inline thread_local RequestTimes* current_ = nullptr;
  RequestTimes* const outer_;
};

}  // namespace isofield::engine
