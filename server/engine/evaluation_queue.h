// Where requests for values at points wait, and small ones join.
#pragma once

#include <absl/status/status.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "engine/field_evaluator.h"
#include "gpu/turns.h"

namespace isofield::engine {

struct QueueLimits {
  // Of requests that wait or run: beyond either a new one is refused, unless none is there.
  std::uint64_t max_requests = 1024;
  std::uint64_t max_points = 1u << 23;
  // For how long a submission that could start is held back for more to join it.
  std::chrono::microseconds delay{0};
};

// One request.
struct PointBatch {
  SceneLease scene;
  std::span<const float> xyz;  // 3 finite numbers a point
  Quantity quantity = Quantity::kValue;
  std::span<float> out;  // components(quantity) numbers a point
  int priority = 0;      // the higher first
  gpu::Deadline deadline = gpu::Deadline::max();
  FieldEvaluator::Cancelled cancelled;
  // Not refused: of those whose number is limited elsewhere.
  bool is_admitted = false;
};

// After this many milliseconds a refused request may be sent again; of the status of a refusal alone.
std::optional<std::int64_t> retry_after_ms(const absl::Status& status);

// Small batches that wait when the device becomes free, of one scene and one quantity, go to it together, the most
// urgent first: higher priority, then earlier deadline, then first come; the last of every kPatience submissions is
// that of the batch that has waited longest. A large batch goes alone, and small ones pass between its pieces.
//
// There is no thread of its own: a caller whose batch waits and who finds no other at it runs the next submission, with
// whatever is in it. So a lone batch costs no change of threads. Thread-safe.
class EvaluationQueue {
 public:
  // Batches up to this size are small, and so many points at most are joined.
  static constexpr std::size_t kSmallPoints = 4096, kJoinedPoints = 16'384;

  // Runs a submission; FieldEvaluator::evaluate, where it is no test's.
  using Run =
      std::function<absl::Status(const ResidentScene&, std::span<const float> xyz, Quantity, std::span<float> out,
                                 const FieldEvaluator::Cancelled&, FieldEvaluator::Submission)>;
  using Clock = std::function<gpu::Deadline()>;

  EvaluationQueue(gpu::Turns& turns, Run run, const QueueLimits& limits, Clock now = std::chrono::system_clock::now)
      : turns_(turns), run_(std::move(run)), limits_(limits), now_(std::move(now)) {}

  // Until `out` is written. RESOURCE_EXHAUSTED: the queue is full; at once, and with retry_after_ms. DEADLINE_EXCEEDED,
  // CANCELLED: before it was run, or between pieces. Others: those of the evaluation, which all in a submission share.
  absl::Status evaluate(const PointBatch& batch);

  // Small batches that wait.
  std::size_t waiting() const;

 private:
  struct Waiting {
    const PointBatch& batch;
    bool is_done = false;
    absl::Status status;
    std::condition_variable changed;
  };
  class Admission;

  absl::Status admit(const PointBatch& batch);
  void leave(const PointBatch& batch);
  absl::Status evaluate_large(const PointBatch& batch);
  absl::Status evaluate_small(const PointBatch& batch);
  void run_next();
  gpu::Urgency most_urgent() const;
  void wait_for_more(std::unique_lock<std::mutex>& lock);
  std::vector<Waiting*> take_next();
  absl::Status run_joined(const std::vector<Waiting*>& joined, gpu::Turns::Turn turn);
  absl::Status refusal() const;
  // run_, timed.
  absl::Status run(const PointBatch& first, std::span<const float> xyz, std::span<float> out,
                   const FieldEvaluator::Cancelled& cancelled, gpu::Turns::Turn turn);

  gpu::Turns& turns_;
  const Run run_;
  const QueueLimits limits_;
  const Clock now_;

  mutable std::mutex mutex_;
  std::list<Waiting*> waiting_;  // by arrival
  std::uint64_t waiting_points_ = 0;
  std::condition_variable more_came_;
  bool is_led_ = false;  // a caller is at the next submission
  std::uint64_t picks_ = 0;
  std::uint64_t requests_ = 0, points_ = 0;  // admitted and not yet answered
  double seconds_per_point_ = 0;             // of late
};

}  // namespace isofield::engine
