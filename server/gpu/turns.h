// Decides which thread may use the device's queue next. One thread has the turn at a time, and the most urgent waiting
// one gets it next.
#pragma once

#include <chrono>
#include <cstdint>
#include <list>
#include <memory>

#include "base/mutex.h"
#include "gpu/device_profile.h"

namespace isofield::gpu {

using Deadline = std::chrono::system_clock::time_point;

// The urgency of work, by which waiting threads are ordered: short work first, then priority, then deadline.
struct Urgency {
  // Work that is known to be short goes before all other work, whatever the priorities.
  bool is_short = false;
  int priority = 0;  // the higher goes first
  Deadline deadline = Deadline::max();

  bool operator==(const Urgency&) const = default;
};
// Tells whether `a` goes before `b`. If neither is more urgent, the one that came first goes first.
bool is_more_urgent(const Urgency& a, const Urgency& b);

// Thread-safe. It must outlive its turns.
class Turns {
 public:
  // The right to use the queue, which is held until this is destroyed or assigned to. A default object holds none.
  class Turn {
   public:
    Turn() = default;
    explicit operator bool() const { return turns_ != nullptr; }

   private:
    friend class Turns;
    struct Release {
      void operator()(Turns* turns) const { turns->release(); }
    };
    explicit Turn(Turns* turns) : turns_(turns) {}
    std::unique_ptr<Turns, Release> turns_;
  };

  // Every `patience`-th pick goes to the thread that has waited longest, so that none waits for ever.
  explicit Turns(std::uint64_t patience = DeviceProfile().patience) : patience_(patience) {}

  // Waits for the turn and returns it. A thread that holds it must not ask for it again.
  Turn take(const Urgency& urgency);
  // Returns the number of threads that wait in take().
  std::size_t waiting() const;

 private:
  struct Waiter {
    Urgency urgency;
    bool is_next = false;
    base::Condition called;
  };
  void release();

  const std::uint64_t patience_;
  mutable base::Mutex mutex_;
  std::list<Waiter*> waiters_ ABSL_GUARDED_BY(mutex_);  // in the order of arrival
  bool is_taken_ ABSL_GUARDED_BY(mutex_) = false;
  std::uint64_t picks_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace isofield::gpu
