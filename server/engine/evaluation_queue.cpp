#include "engine/evaluation_queue.h"

#include <absl/strings/cord.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

#include "engine/status_macros.h"

namespace isofield::engine {
namespace {

constexpr char kRetryPayload[] = "isofield/retry-after-ms";

std::size_t points_of(const PointBatch& batch) {
  return batch.xyz.size() / 3;
}

gpu::Urgency urgency_of(const PointBatch& batch) {
  return {points_of(batch) <= EvaluationQueue::kSmallPoints, batch.priority, batch.deadline};
}

absl::Status deadline_exceeded() {
  return absl::DeadlineExceededError("the request's deadline has passed before it was run");
}

}  // namespace

std::optional<std::int64_t> retry_after_ms(const absl::Status& status) {
  const auto payload = status.GetPayload(kRetryPayload);
  std::int64_t ms = 0;
  if (!payload || !absl::SimpleAtoi(std::string(*payload), &ms)) return std::nullopt;
  return ms;
}

// Counted while it lives.
class EvaluationQueue::Admission {
 public:
  Admission(EvaluationQueue& queue, const PointBatch& batch) : queue_(queue), batch_(batch) {}
  ~Admission() { queue_.leave(batch_); }
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

 private:
  EvaluationQueue& queue_;
  const PointBatch& batch_;
};

absl::Status EvaluationQueue::evaluate(const PointBatch& batch) {
  if (batch.xyz.empty()) return absl::OkStatus();
  ISOFIELD_RETURN_IF_ERROR(admit(batch));
  const Admission admission(*this, batch);
  return points_of(batch) <= kSmallPoints ? evaluate_small(batch) : evaluate_large(batch);
}

std::size_t EvaluationQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size();
}

absl::Status EvaluationQueue::admit(const PointBatch& batch) {
  const std::lock_guard lock(mutex_);
  const bool fits = requests_ < limits_.max_requests && points_ + points_of(batch) <= limits_.max_points;
  if (!fits && !batch.is_admitted && requests_ > 0) return refusal();
  ++requests_;
  points_ += points_of(batch);
  return absl::OkStatus();
}

void EvaluationQueue::leave(const PointBatch& batch) {
  const std::lock_guard lock(mutex_);
  --requests_;
  points_ -= points_of(batch);
}

absl::Status EvaluationQueue::refusal() const {
  // When what is there is done, as far as one can tell.
  const double ms = std::clamp(std::ceil(1e3 * seconds_per_point_ * static_cast<double>(points_)), 1.0, 10'000.0);
  absl::Status status = absl::ResourceExhaustedError(absl::StrCat(
      requests_, " requests with ", points_, " points wait or run; ", limits_.max_requests, " with ",
      limits_.max_points, " are admitted (--max-queued-requests, --max-queued-points): try again in ", ms, " ms"));
  status.SetPayload(kRetryPayload, absl::Cord(absl::StrCat(ms)));
  return status;
}

absl::Status EvaluationQueue::evaluate_large(const PointBatch& batch) {
  const auto is_late = [&] { return batch.deadline <= now_(); };
  if (is_late()) return deadline_exceeded();
  const absl::Status status =
      run(batch, batch.xyz, batch.out, [&] { return (batch.cancelled && batch.cancelled()) || is_late(); }, {});
  return absl::IsCancelled(status) && is_late() ? deadline_exceeded() : status;
}

absl::Status EvaluationQueue::evaluate_small(const PointBatch& batch) {
  Waiting self{batch};
  std::unique_lock lock(mutex_);
  waiting_.push_back(&self);
  waiting_points_ += points_of(batch);
  more_came_.notify_one();
  while (!self.is_done) {
    if (is_led_) {
      self.changed.wait(lock);
      continue;
    }
    is_led_ = true;
    lock.unlock();
    run_next();
    lock.lock();
    is_led_ = false;
  }
  // One of those who still wait goes on.
  if (!is_led_ && !waiting_.empty()) waiting_.front()->changed.notify_one();
  return self.status;
}

// By the caller that leads: what is to go next is decided when the device is free.
void EvaluationQueue::run_next() {
  std::unique_lock lock(mutex_);
  wait_for_more(lock);
  const gpu::Urgency urgency = most_urgent();
  lock.unlock();
  gpu::Turns::Turn turn = turns_.take(urgency);
  lock.lock();
  const std::vector<Waiting*> joined = take_next();
  lock.unlock();
  std::vector<Waiting*> running;
  for (Waiting* w : joined) {
    if (w->batch.deadline <= now_()) {
      w->status = deadline_exceeded();
    } else if (w->batch.cancelled && w->batch.cancelled()) {
      w->status = absl::CancelledError("the request was cancelled");
    } else {
      running.push_back(w);
    }
  }
  if (!running.empty()) {
    const absl::Status status = run_joined(running, std::move(turn));
    for (Waiting* w : running) w->status = status;
  }
  lock.lock();
  for (Waiting* w : joined) {
    w->is_done = true;
    w->changed.notify_one();  // under the lock: it may be gone after that
  }
}

gpu::Urgency EvaluationQueue::most_urgent() const {
  gpu::Urgency most = urgency_of(waiting_.front()->batch);
  for (const Waiting* w : waiting_) {
    if (const gpu::Urgency u = urgency_of(w->batch); gpu::is_more_urgent(u, most)) most = u;
  }
  return most;
}

void EvaluationQueue::wait_for_more(std::unique_lock<std::mutex>& lock) {
  if (limits_.delay.count() == 0) return;
  more_came_.wait_for(lock, limits_.delay, [&] { return waiting_points_ >= kJoinedPoints; });
}

// The first one, and those that can go with it in the order of their urgency.
std::vector<EvaluationQueue::Waiting*> EvaluationQueue::take_next() {
  std::vector<Waiting*> order(waiting_.begin(), waiting_.end());
  const bool is_oldest_first = ++picks_ % gpu::kPatience == 0;
  std::stable_sort(order.begin() + (is_oldest_first ? 1 : 0), order.end(), [](const Waiting* a, const Waiting* b) {
    return gpu::is_more_urgent(urgency_of(a->batch), urgency_of(b->batch));
  });
  std::vector<Waiting*> joined;
  std::size_t points = 0;
  for (Waiting* w : order) {
    const PointBatch& first = order.front()->batch;
    if (w->batch.scene != first.scene || w->batch.quantity != first.quantity) continue;
    if (!joined.empty() && points + points_of(w->batch) > kJoinedPoints) break;
    points += points_of(w->batch);
    joined.push_back(w);
  }
  for (Waiting* w : joined) std::erase(waiting_, w);
  waiting_points_ -= points;
  return joined;
}

absl::Status EvaluationQueue::run_joined(const std::vector<Waiting*>& joined, gpu::Turns::Turn turn) {
  const PointBatch& first = joined.front()->batch;
  if (joined.size() == 1) return run(first, first.xyz, first.out, first.cancelled, std::move(turn));
  std::vector<float> xyz;
  for (const Waiting* w : joined) xyz.insert(xyz.end(), w->batch.xyz.begin(), w->batch.xyz.end());
  std::vector<float> out(xyz.size() / 3 * components(first.quantity));
  // Goes on for as long as one of them wants it.
  const auto cancelled = [&] {
    return std::all_of(joined.begin(), joined.end(),
                       [](const Waiting* w) { return w->batch.cancelled && w->batch.cancelled(); });
  };
  ISOFIELD_RETURN_IF_ERROR(run(first, xyz, out, cancelled, std::move(turn)));
  auto from = out.begin();
  for (const Waiting* w : joined) {
    std::copy_n(from, w->batch.out.size(), w->batch.out.begin());
    from += static_cast<std::ptrdiff_t>(w->batch.out.size());
  }
  return absl::OkStatus();
}

absl::Status EvaluationQueue::run(const PointBatch& first, std::span<const float> xyz, std::span<float> out,
                                  const FieldEvaluator::Cancelled& cancelled, gpu::Turns::Turn turn) {
  const gpu::Deadline start = now_();
  const absl::Status status =
      run_(*first.scene, xyz, first.quantity, out, cancelled, {urgency_of(first), std::move(turn)});
  const double seconds = std::chrono::duration<double>(now_() - start).count() / static_cast<double>(xyz.size() / 3);
  const std::lock_guard lock(mutex_);
  seconds_per_point_ += 0.1 * (seconds - seconds_per_point_);
  return status;
}

}  // namespace isofield::engine
