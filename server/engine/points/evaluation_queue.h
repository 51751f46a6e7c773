// A queue in which requests for values at points wait for the device, and small ones are joined.
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
  // How long a submission that could start is held back so that others can join it.
  std::chrono::microseconds delay{0};
};

// One request.
struct PointBatch {
  SceneLease scene;
  std::span<const float> xyz;  // as of FieldEvaluator::evaluate
  ResultLayout layout = ResultLayout::kValue;
  std::span<float> out;  // rows of the layout
  int priority = 0;      // the higher first
  gpu::Deadline deadline = gpu::Deadline::max();
  FieldEvaluator::Cancelled cancelled;
  // If it is not null, it receives how long the batch waited and ran, before the batch is done.
  RequestTimes* times = nullptr;
};

// Small batches that wait when the device becomes free, of one scene and one layout, go to it together, the most
// urgent first: higher priority, then earlier deadline, then first come; the last of every `patience` submissions is
// that of the batch that has waited longest. A large batch goes alone, and small ones pass between its slabs.
//
// A caller who finds nobody at it runs the next submission, with what is in it, so that a lone batch costs no change of
// threads; what waits then is the queue's own thread's, and the next caller's. Thread-safe; nothing may wait when it is
// destroyed.
class EvaluationQueue {
 public:
  // Runs a submission; FieldEvaluator::evaluate, where it is no test's.
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

  // Called once with the outcome, when `out` is written: on the caller's thread, or on that of whoever ran the
  // submission.
  using Done = std::function<void(const absl::Status&)>;

  // DEADLINE_EXCEEDED, CANCELLED: before it was run, or between slabs. Others: those of the evaluation, which all in a
  // submission share. A large batch is run before this returns.
  void submit(PointBatch batch, Done done);
  // The same, and waits for the outcome.
  absl::Status evaluate(const PointBatch& batch);

  // Small batches that wait.
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
  // run_, timed.
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
  bool is_led_ ABSL_GUARDED_BY(mutex_) = false;  // a thread is at the next submission
  bool is_over_ ABSL_GUARDED_BY(mutex_) = false;
  std::uint64_t picks_ ABSL_GUARDED_BY(mutex_) = 0;
  std::thread dispatcher_;  // last: it uses the others
};

}  // namespace isofield::engine
