// EvaluationQueue holds requests for values at points until the device is free, and joins small ones into one
// submission.
#pragma once

#include <absl/status/status.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "engine/points/field_evaluator.h"
#include "engine/request_times.h"
#include "gpu/turns.h"

namespace isofield::engine {

struct QueueOptions {
  // The time for which a submission that could start is held back so that other batches can join it.
  std::chrono::microseconds delay{0};
};

// The points of one request. The memory of `xyz` and `out` must stay valid until the batch is done.
struct PointBatch {
  SceneLease scene;
  std::span<const float> xyz;  // 3 numbers a point, as FieldEvaluator::evaluate takes them
  ResultLayout layout = ResultLayout::kValue;
  std::span<float> out;  // a row of the layout for each point
  int priority = 0;      // higher numbers go first
  gpu::Deadline deadline = gpu::Deadline::max();
  FieldEvaluator::Cancelled cancelled;
  // If it is not null, it receives how long the batch waited and ran, before the batch is done.
  RequestTimes* times = nullptr;
};

// When the device becomes free, it gets the most urgent batch: that of the highest priority, then of the earliest
// deadline, then the first that came. Small batches of the same scene and layout that wait go with it in one
// submission. The last of every `patience` submissions begins with the batch that has waited longest. A large batch
// goes alone, and small ones may pass between its slabs.
//
// A caller who finds that no thread is preparing a submission runs the next one itself, with all batches that belong to
// it, so that a lone batch costs no change of threads. The batches that still wait after that are left to the queue's
// own thread or to the next caller. Thread-safe; no batch may be waiting when the queue is destroyed.
class EvaluationQueue {
 public:
  // Runs a submission. It is FieldEvaluator::evaluate, except in tests.
  using Run =
      std::function<absl::Status(const ResidentScene&, std::span<const float> xyz, ResultLayout, std::span<float> out,
                                 const FieldEvaluator::Cancelled&, FieldEvaluator::Submission)>;
  using Clock = std::function<gpu::Deadline()>;

  EvaluationQueue(gpu::Turns& turns, const gpu::DeviceProfile& profile, Run run, const QueueOptions& options,
                  Clock now = std::chrono::system_clock::now)
      : turns_(turns),
        profile_(profile),
        run_(std::move(run)),
        options_(options),
        now_(std::move(now)),
        dispatcher_([this] { dispatch(); }) {}
  ~EvaluationQueue();

  // The queue calls it once with the outcome, after `out` is written, on the caller's thread or on the thread that ran
  // the submission.
  using Done = std::function<void(const absl::Status&)>;

  // Queues a batch, or runs it at once. A large batch is done when this returns. DEADLINE_EXCEEDED, CANCELLED: the
  // deadline passed, or the request was cancelled, before the batch was run or between its slabs. Other errors are
  // those of the evaluation; all batches of a submission share them.
  void submit(PointBatch batch, Done done);
  // The same, but it waits for the outcome and returns it.
  absl::Status evaluate(const PointBatch& batch);

  // Returns the number of small batches that wait.
  std::size_t waiting() const;

 private:
  struct Waiting {
    PointBatch batch;
    Done done;
    absl::Status status;
    std::chrono::steady_clock::time_point came = std::chrono::steady_clock::now();
  };
  using Batches = std::vector<std::unique_ptr<Waiting>>;

  bool is_small(const PointBatch& batch) const;
  gpu::Urgency urgency_of(const PointBatch& batch) const;
  absl::Status evaluate_large(const PointBatch& batch);
  void dispatch();
  Batches run_next() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  gpu::Urgency most_urgent() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void wait_for_more() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Batches take_next() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status run_joined(const std::vector<Waiting*>& joined, gpu::Turns::Turn turn, RequestTimes& times);
  // Calls run_, and adds the times that it takes to `times`.
  absl::Status run(const PointBatch& first, std::span<const float> xyz, std::span<float> out,
                   const FieldEvaluator::Cancelled& cancelled, gpu::Turns::Turn turn, RequestTimes& times);

  gpu::Turns& turns_;
  const gpu::DeviceProfile& profile_;
  const Run run_;
  const QueueOptions options_;
  const Clock now_;

  mutable base::Mutex mutex_;
  Batches waiting_ ABSL_GUARDED_BY(mutex_);  // by arrival
  std::uint64_t waiting_points_ ABSL_GUARDED_BY(mutex_) = 0;
  base::Condition more_came_, left_over_;
  bool is_led_ ABSL_GUARDED_BY(mutex_) = false;  // a thread prepares or runs a submission
  bool is_over_ ABSL_GUARDED_BY(mutex_) = false;
  std::uint64_t picks_ ABSL_GUARDED_BY(mutex_) = 0;
  std::thread dispatcher_;  // the last member, since it uses the others
};

}  // namespace isofield::engine
