// Tests which batches are joined and which go first. There is no device, and the clock is a variable.
#include "engine/points/evaluation_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <new>
#include <thread>

#include "support/eventually.h"

namespace isofield::engine {
namespace {

constexpr gpu::Deadline kNow = gpu::Deadline() + std::chrono::hours(1);
constexpr gpu::DeviceProfile kProfile;
constexpr gpu::Deadline kSoon = kNow + std::chrono::hours(1), kLater = kNow + std::chrono::hours(2);

// The queue never dereferences these scenes.
SceneLease scene_number(std::uintptr_t n) {
  return {std::shared_ptr<const ResidentScene>(), reinterpret_cast<const ResidentScene*>(n * 64)};
}

// A queue before a device that another user holds until release(). The field is the sum of a point's coordinates.
class Queue : public testing::Test {
 protected:
  struct Submission {
    const ResidentScene* scene;
    std::vector<float> xyz;
    ResultLayout layout;
    gpu::Urgency urgency;
  };
  struct Request {
    PointBatch batch;
    std::vector<float> xyz, out;
    absl::Status status = absl::UnknownError("not answered");
    std::thread thread;
  };

  explicit Queue(const QueueOptions& options = {})
      : held_(turns_.take({})),
        queue_(
            turns_, kProfile,
            [this](const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                   const FieldEvaluator::Cancelled& cancelled, FieldEvaluator::Submission submission) {
              return run(scene, xyz, layout, out, cancelled, std::move(submission));
            },
            options, [this] { return now_; }) {}
  ~Queue() override { release(); }

  absl::Status run(const ResidentScene& scene, std::span<const float> xyz, ResultLayout layout, std::span<float> out,
                   const FieldEvaluator::Cancelled& cancelled, FieldEvaluator::Submission submission) {
    if (!submission.turn) submission.turn = turns_.take(submission.urgency);
    if (cancelled && cancelled()) return absl::CancelledError("the request was cancelled");
    if (has_no_memory_) throw std::bad_alloc();
    submissions_.push_back({&scene, {xyz.begin(), xyz.end()}, layout, submission.urgency});
    for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
      out[i * layout.numbers()] = xyz[3 * i] + xyz[3 * i + 1] + xyz[3 * i + 2];
    }
    return outcome_;
  }

  // Makes a request for points whose coordinates each have the sum `value`.
  Request& request(float value, std::size_t points = 1, PointBatch batch = {}) {
    Request& r = *requests_.emplace_back(std::make_unique<Request>());
    for (std::size_t i = 0; i < points; ++i) r.xyz.insert(r.xyz.end(), {value, 0, 0});
    r.out.resize(points * batch.layout.numbers());
    if (!batch.scene) batch.scene = scene_number(1);
    r.batch = std::move(batch);
    r.batch.xyz = r.xyz;
    r.batch.out = r.out;
    return r;
  }
  // Sends the request, and returns when it waits.
  Request& wait_with(Request& r) {
    const std::size_t before = queue_.waiting() + turns_.waiting();
    r.thread = std::thread([this, &r] { r.status = queue_.evaluate(r.batch); });
    // The first small request waits in the queue, and its caller waits for the turn.
    EXPECT_TRUE(test_support::eventually([&] { return queue_.waiting() + turns_.waiting() > before; }));
    EXPECT_TRUE(test_support::eventually([&] { return queue_.waiting() == 0 || turns_.waiting() > 0; }));
    return r;
  }
  void release() {
    held_ = {};
    for (auto& r : requests_) {
      if (r->thread.joinable()) r->thread.join();
    }
  }
  // Returns the first coordinates of a submission's points.
  std::vector<float> values(std::size_t submission) const {
    std::vector<float> all;
    for (std::size_t i = 0; i < submissions_.at(submission).xyz.size(); i += 3) {
      all.push_back(submissions_[submission].xyz[i]);
    }
    return all;
  }

  gpu::Deadline now_ = kNow;
  gpu::Turns turns_;
  gpu::Turns::Turn held_;
  absl::Status outcome_;
  std::atomic<bool> has_no_memory_ = false;
  std::vector<Submission> submissions_;  // only written under the turn
  std::vector<std::unique_ptr<Request>> requests_;
  EvaluationQueue queue_;
};

using Values = std::vector<float>;

TEST_F(Queue, ALoneBatchIsRunByItsCaller) {
  held_ = {};
  Request& r = request(5, 3);
  r.status = queue_.evaluate(r.batch);
  EXPECT_TRUE(r.status.ok());
  EXPECT_EQ(r.out, (Values{5, 5, 5}));
  ASSERT_EQ(submissions_.size(), 1u);
  EXPECT_TRUE(submissions_[0].urgency.is_short);
}

TEST_F(Queue, WhatWaitsGoesTogetherAndEachGetsItsOwn) {
  for (int i = 0; i < 20; ++i) wait_with(request(static_cast<float>(i), 1 + i % 3));
  release();
  ASSERT_EQ(submissions_.size(), 1u);
  EXPECT_EQ(submissions_[0].xyz.size(), 3u * (7 * 1 + 7 * 2 + 6 * 3));
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(requests_[i]->status.ok());
    EXPECT_EQ(requests_[i]->out, Values(1 + i % 3, static_cast<float>(i)));
  }
}

TEST_F(Queue, OtherScenesAndQuantitiesGoApart) {
  wait_with(request(1));
  wait_with(request(2, 1, {.scene = scene_number(2)}));
  wait_with(request(3, 1, {.layout = ResultLayout::kValueAndGradient}));
  wait_with(request(4));
  release();
  ASSERT_EQ(submissions_.size(), 3u);
  EXPECT_EQ(values(0), (Values{1, 4}));
  EXPECT_EQ(values(1), Values{2});
  EXPECT_EQ(values(2), Values{3});
  EXPECT_EQ(submissions_[1].scene, scene_number(2).get());
  EXPECT_EQ(submissions_[2].layout, ResultLayout::kValueAndGradient);
  EXPECT_EQ(requests_[2]->out.size(), 4u);
}

TEST_F(Queue, PriorityThenDeadlineThenArrival) {
  wait_with(request(1));
  wait_with(request(2, 1, {.deadline = kLater}));
  wait_with(request(3, 1, {.priority = 1}));
  wait_with(request(4, 1, {.deadline = kSoon}));
  wait_with(request(5, 1, {.priority = -1, .deadline = kSoon}));
  wait_with(request(6));
  release();
  ASSERT_EQ(submissions_.size(), 1u);
  EXPECT_EQ(values(0), (Values{3, 4, 2, 1, 6, 5}));
}

TEST_F(Queue, NoMoreIsJoinedThanTheBound) {
  constexpr std::size_t kMost = kProfile.small_points;
  for (int i = 0; i < 6; ++i) wait_with(request(static_cast<float>(i), kMost));
  release();
  ASSERT_EQ(submissions_.size(), 2u);
  EXPECT_EQ(submissions_[0].xyz.size(), 3 * kProfile.joined_points);
  EXPECT_EQ(submissions_[1].xyz.size(), 3 * 2 * kMost);
}

TEST_F(Queue, TheOldestIsNotPassedForEver) {
  wait_with(request(0, 1, {.priority = -1}));
  for (int i = 1; i <= 5; ++i) {
    wait_with(request(static_cast<float>(i), 1, {.scene = scene_number(1 + i), .priority = 1}));
  }
  release();
  ASSERT_EQ(submissions_.size(), 6u);
  EXPECT_EQ(values(3), Values{0});
  EXPECT_EQ(values(5), Values{5});
}

TEST_F(Queue, LargeBatchesGoAloneAndAreNotShort) {
  wait_with(request(1, kProfile.small_points + 1));
  wait_with(request(2));
  wait_with(request(3));
  release();
  ASSERT_EQ(submissions_.size(), 2u);
  EXPECT_EQ(values(0), (Values{2, 3}));
  EXPECT_FALSE(submissions_[1].urgency.is_short);
  EXPECT_EQ(requests_[0]->out, Values(kProfile.small_points + 1, 1.0f));
}

TEST_F(Queue, APassedDeadlineIsAnsweredWithoutARun) {
  wait_with(request(1, 1, {.deadline = kSoon}));
  wait_with(request(2));
  wait_with(request(3, kProfile.small_points + 1, {.deadline = kSoon}));
  now_ = kSoon;
  release();
  EXPECT_EQ(requests_[0]->status.code(), absl::StatusCode::kDeadlineExceeded);
  EXPECT_TRUE(requests_[1]->status.ok());
  EXPECT_EQ(requests_[2]->status.code(), absl::StatusCode::kDeadlineExceeded);
  ASSERT_EQ(submissions_.size(), 1u);
  EXPECT_EQ(values(0), Values{2});
}

TEST_F(Queue, ACancelledBatchIsNotRun) {
  std::atomic<bool> is_cancelled = false;
  wait_with(request(1, 1, {.cancelled = [&] { return is_cancelled.load(); }}));
  wait_with(request(2, 1, {.cancelled = [] { return false; }}));
  is_cancelled = true;
  release();
  EXPECT_EQ(requests_[0]->status.code(), absl::StatusCode::kCancelled);
  EXPECT_TRUE(requests_[1]->status.ok());
  EXPECT_EQ(values(0), Values{2});
}

TEST_F(Queue, AFailureIsThatOfAllThatWentTogether) {
  wait_with(request(1));
  wait_with(request(2));
  outcome_ = absl::InternalError("no device");
  release();
  EXPECT_EQ(requests_[0]->status, outcome_);
  EXPECT_EQ(requests_[1]->status, outcome_);
}

TEST_F(Queue, ExceptionsAreAnsweredAndEndNothing) {
  wait_with(request(1));
  wait_with(request(2));
  wait_with(request(3, kProfile.small_points + 1));
  has_no_memory_ = true;
  release();
  for (const auto& r : requests_) EXPECT_EQ(r->status.code(), absl::StatusCode::kResourceExhausted);
  has_no_memory_ = false;
  Request& next = request(4);
  EXPECT_TRUE(queue_.evaluate(next.batch).ok());
}

TEST_F(Queue, WhatAsksForNothingIsDoneAtOnce) {
  Request& nothing = request(4, 0);
  EXPECT_TRUE(queue_.evaluate(nothing.batch).ok());
  EXPECT_TRUE(submissions_.empty());
}

class DelayedQueue : public Queue {
 protected:
  DelayedQueue() : Queue({.delay = std::chrono::hours(1)}) {}
};

TEST_F(DelayedQueue, AFullSubmissionIsNotHeldBack) {
  held_ = {};
  for (int i = 0; i < 4; ++i) {
    Request& r = request(static_cast<float>(i), kProfile.small_points);
    r.thread = std::thread([this, &r] { r.status = queue_.evaluate(r.batch); });
  }
  release();
  ASSERT_EQ(submissions_.size(), 1u);
  EXPECT_EQ(submissions_[0].xyz.size(), 3 * kProfile.joined_points);
}

}  // namespace
}  // namespace isofield::engine
