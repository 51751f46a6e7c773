// Who uses the device's queue next: one piece of work at a time, the most urgent first.
#pragma once

#include <chrono>
#include <cstdint>
#include <list>
#include <memory>

#include "base/mutex.h"
#include "gpu/device_profile.h"

namespace isofield::gpu {

using Deadline = std::chrono::system_clock::time_point;

// What is asked before what.
struct Urgency {
  // Work known to be short passes all other, whatever their priorities.
  bool is_short = false;
  int priority = 0;  // the higher first
  Deadline deadline = Deadline::max();

  bool operator==(const Urgency&) const = default;
};
// True where `a` goes before `b`; of equal ones the first to come.
bool is_more_urgent(const Urgency& a, const Urgency& b);

// Thread-safe. Must outlive its turns.
class Turns {
 public:
  // Held until it is destroyed or assigned to; a default one is no turn.
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

  // Of `patience` picks, the last goes to the one that has waited longest, so that none waits for ever.
  explicit Turns(std::uint64_t patience = DeviceProfile().patience) : patience_(patience) {}

  // Waits for it. A thread that holds one must not ask for another.
  Turn take(const Urgency& urgency);
  // Threads in take().
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
  std::list<Waiter*> waiters_ ABSL_GUARDED_BY(mutex_);  // by arrival
  bool is_taken_ ABSL_GUARDED_BY(mutex_) = false;
  std::uint64_t picks_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace isofield::gpu
