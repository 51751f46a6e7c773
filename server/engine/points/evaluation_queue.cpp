#include "engine/points/evaluation_queue.h"

#include <algorithm>
#include <future>

#include "base/guarded.h"
#include "base/status_macros.h"

namespace isofield::engine {
namespace {

std::size_t points_of(const PointBatch& batch) {
  return batch.xyz.size() / 3;
}

absl::Status deadline_exceeded() {
  return absl::DeadlineExceededError("the request's deadline has passed before it was run");
}

}  // namespace

EvaluationQueue::~EvaluationQueue() {
  {
    const base::MutexLock lock(mutex_);
    is_over_ = true;
  }
  left_over_.notify_one();
  dispatcher_.join();
}

bool EvaluationQueue::is_small(const PointBatch& batch) const {
  return points_of(batch) <= profile_.small_points;
}

gpu::Urgency EvaluationQueue::urgency_of(const PointBatch& batch) const {
  return {is_small(batch), batch.priority, batch.deadline};
}

void EvaluationQueue::submit(PointBatch batch, Done done) {
  if (batch.xyz.empty()) return done(absl::OkStatus());
  if (!is_small(batch)) return done(evaluate_large(batch));
  auto self = std::make_unique<Waiting>(Waiting{.batch = std::move(batch), .done = std::move(done), .status = {}});
  Batches answered;
  {
    base::MutexLock lock(mutex_);
    waiting_points_ += points_of(self->batch);
    waiting_.push_back(std::move(self));
    more_came_.notify_one();
    if (is_led_) return;
    answered = run_next();
  }
  for (const auto& a : answered) a->done(a->status);
}

absl::Status EvaluationQueue::evaluate(const PointBatch& batch) {
  // The promise is shared, so that it outlives the call of `done` that ends the wait.
  const auto outcome = std::make_shared<std::promise<absl::Status>>();
  std::future<absl::Status> future = outcome->get_future();
  submit(batch, [outcome](const absl::Status& status) { outcome->set_value(status); });
  return future.get();
}

void EvaluationQueue::dispatch() {
  base::MutexLock lock(mutex_);
  while (true) {
    while (!is_over_ && (is_led_ || waiting_.empty())) left_over_.wait(mutex_);
    if (is_over_) return;
    const Batches answered = run_next();
    lock.unlock();
    for (const auto& a : answered) a->done(a->status);
    lock.lock();
  }
}

std::size_t EvaluationQueue::waiting() const {
  const base::MutexLock lock(mutex_);
  return waiting_.size();
}

absl::Status EvaluationQueue::evaluate_large(const PointBatch& batch) {
  const auto is_late = [&] { return batch.deadline <= now_(); };
  if (is_late()) return deadline_exceeded();
  RequestTimes unasked;
  const auto cancelled = [&] { return (batch.cancelled && batch.cancelled()) || is_late(); };
  const absl::Status status = base::guarded(
      [&] { return run(batch, batch.xyz, batch.out, cancelled, {}, batch.times ? *batch.times : unasked); });
  return absl::IsCancelled(status) && is_late() ? deadline_exceeded() : status;
}

// Runs one submission. It decides what goes next only when the device is free, and unlocks while it waits for that and
// while it runs. The caller must call `done` of the batches that it returns, so that the next submission need not wait
// for these calls.
EvaluationQueue::Batches EvaluationQueue::run_next() {
  is_led_ = true;
  wait_for_more();
  const gpu::Urgency urgency = most_urgent();
  mutex_.unlock();
  gpu::Turns::Turn turn = turns_.take(urgency);
  mutex_.lock();
  Batches taken = take_next();
  mutex_.unlock();
  std::vector<Waiting*> running;
  for (const auto& w : taken) {
    if (w->batch.deadline <= now_()) {
      w->status = deadline_exceeded();
    } else if (w->batch.cancelled && w->batch.cancelled()) {
      w->status = absl::CancelledError("the request was cancelled");
    } else {
      running.push_back(w.get());
    }
  }
  if (!running.empty()) {
    const auto start = std::chrono::steady_clock::now();
    RequestTimes times;
    const absl::Status status =
        base::guarded([&] { return run_joined(running, std::move(turn), times); });  // else none would be answered
    for (Waiting* w : running) {
      w->status = status;
      if (!w->batch.times) continue;
      w->batch.times->add_queued(start - w->came + times.queued());
      w->batch.times->add_on_device(times.on_device());
    }
  }
  turn = {};
  mutex_.lock();
  is_led_ = false;
  if (!waiting_.empty()) left_over_.notify_one();
  return taken;
}

gpu::Urgency EvaluationQueue::most_urgent() const {
  gpu::Urgency most = urgency_of(waiting_.front()->batch);
  for (const auto& w : waiting_) {
    if (const gpu::Urgency u = urgency_of(w->batch); gpu::is_more_urgent(u, most)) most = u;
  }
  return most;
}

void EvaluationQueue::wait_for_more() {
  if (options_.delay.count() == 0) return;
  const auto end = std::chrono::steady_clock::now() + options_.delay;
  while (waiting_points_ < profile_.joined_points && more_came_.wait_until(mutex_, end)) {
  }
}

// Takes the batch that goes first out of the queue, and those that can go with it, in the order of their urgency.
EvaluationQueue::Batches EvaluationQueue::take_next() {
  std::vector<std::unique_ptr<Waiting>*> order;
  for (auto& w : waiting_) order.push_back(&w);
  const bool is_oldest_first = ++picks_ % profile_.patience == 0;
  std::stable_sort(order.begin() + (is_oldest_first ? 1 : 0), order.end(), [this](const auto* a, const auto* b) {
    return gpu::is_more_urgent(urgency_of((*a)->batch), urgency_of((*b)->batch));
  });
  const PointBatch& first = (*order.front())->batch;
  Batches joined;
  std::size_t points = 0;
  for (std::unique_ptr<Waiting>* w : order) {
    const PointBatch& batch = (*w)->batch;
    if (batch.scene != first.scene || batch.layout != first.layout) continue;
    if (!joined.empty() && points + points_of(batch) > profile_.joined_points) break;
    points += points_of(batch);
    joined.push_back(std::move(*w));
  }
  std::erase(waiting_, nullptr);
  waiting_points_ -= points;
  return joined;
}

absl::Status EvaluationQueue::run_joined(const std::vector<Waiting*>& joined, gpu::Turns::Turn turn,
                                         RequestTimes& times) {
  const PointBatch& first = joined.front()->batch;
  if (joined.size() == 1) return run(first, first.xyz, first.out, first.cancelled, std::move(turn), times);
  std::vector<float> xyz;
  for (const Waiting* w : joined) xyz.insert(xyz.end(), w->batch.xyz.begin(), w->batch.xyz.end());
  std::vector<float> out(first.layout.numbers(xyz.size() / 3));
  // The submission goes on as long as one of its batches is not cancelled.
  const auto cancelled = [&] {
    return std::all_of(joined.begin(), joined.end(),
                       [](const Waiting* w) { return w->batch.cancelled && w->batch.cancelled(); });
  };
  ISOFIELD_RETURN_IF_ERROR(run(first, xyz, out, cancelled, std::move(turn), times));
  auto from = out.begin();
  for (const Waiting* w : joined) {
    std::copy_n(from, w->batch.out.size(), w->batch.out.begin());
    from += static_cast<std::ptrdiff_t>(w->batch.out.size());
  }
  return absl::OkStatus();
}

absl::Status EvaluationQueue::run(const PointBatch& first, std::span<const float> xyz, std::span<float> out,
                                  const FieldEvaluator::Cancelled& cancelled, gpu::Turns::Turn turn,
                                  RequestTimes& times) {
  const TimedScope timed(times);
  return run_(*first.scene, xyz, first.layout, out, cancelled, {urgency_of(first), std::move(turn)});
}

}  // namespace isofield::engine
