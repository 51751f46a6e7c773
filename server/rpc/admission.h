// Decides how many requests may be at work at once, and refuses the others.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "base/mutex.h"

namespace isofield::rpc {

struct AdmissionLimits {
  // The most requests, and points of these, that may wait or run. Beyond either limit a further request is refused, but
  // never for its points where the others have none.
  std::uint64_t max_requests = 1;
  std::uint64_t max_points = 1;
  const char* flags = "";  // of the command line, which refusals name
};

// Counts the requests that are at work and their points. Points are what the size of the work is estimated by: points
// of a batch or a grid, rays, rows, or cells of a mesh. Thread-safe; must outlive its tickets.
class Admission {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  explicit Admission(const AdmissionLimits& limits, Clock now = std::chrono::steady_clock::now)
      : limits_(limits), now_(std::move(now)) {}

  // The place of one request, which is held until this is destroyed or assigned to; a default one is no place.
  class Ticket {
   public:
    Ticket() = default;
    Ticket(Ticket&& other) noexcept
        : admission_(std::exchange(other.admission_, nullptr)), points_(std::exchange(other.points_, 0)) {}
    Ticket& operator=(Ticket&& other) noexcept {
      Ticket last(std::move(other));
      std::swap(admission_, last.admission_);
      std::swap(points_, last.points_);
      return *this;
    }
    ~Ticket() {
      if (admission_) admission_->release(points_);
    }

    // Adds points of the request, once they are known. RESOURCE_EXHAUSTED: as of admit().
    absl::Status add(std::uint64_t points);

   private:
    friend class Admission;
    Ticket(Admission* admission, std::uint64_t points) : admission_(admission), points_(points) {}

    Admission* admission_ = nullptr;
    std::uint64_t points_ = 0;
  };

  // RESOURCE_EXHAUSTED: the request is beyond the limits; the status has retry_after_ms().
  absl::StatusOr<Ticket> admit(std::uint64_t points = 0);
  // The same for a request that is never refused, since another limit bounds how many there are of its kind.
  Ticket count(std::uint64_t points);

 private:
  bool has_room_for(std::uint64_t points) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status refusal() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Ticket take(std::uint64_t points) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void release(std::uint64_t points);

  const AdmissionLimits limits_;
  const Clock now_;
  base::Mutex mutex_;
  std::uint64_t requests_ ABSL_GUARDED_BY(mutex_) = 0, points_ ABSL_GUARDED_BY(mutex_) = 0;  // at work
  // Work that ended lately and the time it took, the older the less; for the estimate of when to try again.
  double recent_seconds_ ABSL_GUARDED_BY(mutex_) = 0, recent_work_ ABSL_GUARDED_BY(mutex_) = 0;
  std::chrono::steady_clock::time_point busy_since_ ABSL_GUARDED_BY(mutex_);  // or since the last request ended
};

// After this many milliseconds a request that was refused by admission may be sent again. Nothing for other statuses.
std::optional<std::int64_t> retry_after_ms(const absl::Status& status);

}  // namespace isofield::rpc
