#include "rpc/admission.h"

#include <absl/strings/cord.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>

namespace isofield::rpc {
namespace {

constexpr char kRetryPayload[] = "isofield/retry-after-ms";

// The estimate forgets: after this many further seconds of work, a request that has ended counts only a third (1 / e).
constexpr double kMemorySeconds = 10;

// Returns the size of the work. A request counts as one point more than it has, since one without points is work, too.
double work_of(std::uint64_t requests, std::uint64_t points) {
  return static_cast<double>(requests) + static_cast<double>(points);
}

}  // namespace

std::optional<std::int64_t> retry_after_ms(const absl::Status& status) {
  const auto payload = status.GetPayload(kRetryPayload);
  std::int64_t ms = 0;
  if (!payload || !absl::SimpleAtoi(std::string(*payload), &ms)) return std::nullopt;
  return ms;
}

absl::Status Admission::Ticket::add(std::uint64_t points) {
  if (!admission_) return absl::FailedPreconditionError("points are added to no request");
  const base::MutexLock lock(admission_->mutex_);
  if (!admission_->has_room_for(points)) return admission_->refusal();
  admission_->points_ += points;
  points_ += points;
  return absl::OkStatus();
}

absl::StatusOr<Admission::Ticket> Admission::admit(std::uint64_t points) {
  const base::MutexLock lock(mutex_);
  if (requests_ >= limits_.max_requests || !has_room_for(points)) return refusal();
  return take(points);
}

Admission::Ticket Admission::count(std::uint64_t points) {
  const base::MutexLock lock(mutex_);
  return take(points);
}

bool Admission::has_room_for(std::uint64_t points) const {
  return points_ == 0 || points == 0 || points_ + points <= limits_.max_points;
}

absl::Status Admission::refusal() const {
  // This is an estimate of the time after which all present work is done.
  const double seconds = recent_seconds_ / std::max(recent_work_, 1.0) * work_of(requests_, points_);
  const double ms = std::clamp(std::ceil(1e3 * seconds), 1.0, 10'000.0);
  absl::Status status = absl::ResourceExhaustedError(
      absl::StrCat(requests_, " requests with ", points_, " points wait or run; ", limits_.max_requests, " with ",
                   limits_.max_points, " are admitted (", limits_.flags, "): try again in ", ms, " ms"));
  status.SetPayload(kRetryPayload, absl::Cord(absl::StrCat(ms)));
  return status;
}

Admission::Ticket Admission::take(std::uint64_t points) {
  if (requests_++ == 0) busy_since_ = now_();
  points_ += points;
  return {this, points};
}

void Admission::release(std::uint64_t points) {
  const base::MutexLock lock(mutex_);
  --requests_;
  points_ -= points;
  const auto now = now_();
  const double seconds = std::chrono::duration<double>(now - busy_since_).count();
  busy_since_ = now;
  const double kept = std::exp(-seconds / kMemorySeconds);
  recent_seconds_ = kept * recent_seconds_ + seconds;
  recent_work_ = kept * recent_work_ + work_of(1, points);
}

}  // namespace isofield::rpc
