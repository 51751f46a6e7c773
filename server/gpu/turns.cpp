#include "gpu/turns.h"

#include <algorithm>

namespace isofield::gpu {

bool is_more_urgent(const Urgency& a, const Urgency& b) {
  if (a.is_short != b.is_short) return a.is_short;
  if (a.priority != b.priority) return a.priority > b.priority;
  return a.deadline < b.deadline;
}

Turns::Turn Turns::take(const Urgency& urgency) {
  base::MutexLock lock(mutex_);
  if (is_taken_) {
    Waiter self{urgency};
    waiters_.push_back(&self);
    while (!self.is_next) self.called.wait(mutex_);
  }
  is_taken_ = true;
  return Turn(this);
}

std::size_t Turns::waiting() const {
  const base::MutexLock lock(mutex_);
  return waiters_.size();
}

// Hands the turn to a waiting thread if there is one. The turn is never free in between, so no newcomer can take it.
void Turns::release() {
  const base::MutexLock lock(mutex_);
  is_taken_ = !waiters_.empty();
  if (!is_taken_) return;
  auto next = waiters_.begin();
  if (++picks_ % patience_ != 0) {
    next = std::min_element(waiters_.begin(), waiters_.end(),
                            [](const Waiter* a, const Waiter* b) { return is_more_urgent(a->urgency, b->urgency); });
  }
  Waiter& chosen = **next;
  waiters_.erase(next);
  chosen.is_next = true;
  chosen.called.notify_one();
}

}  // namespace isofield::gpu
