// Limits how many requests, and how much work in all, the server takes on at once, and refuses further ones.
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
  // The most requests that may wait or run, and the most points that they may have together. A further request beyond
  // either limit is refused, but never for its points if the others have none.
  std::uint64_t max_requests = 1;
  std::uint64_t max_points = 1;
  const char* flags = "";  // the options of the command line that set the limits; refusals name them
};

// Counts the requests that are at work and their points. A request's points are an estimate of its work: points of a
// batch or a grid, rays, rows, or cells of a mesh. Thread-safe; must outlive its tickets.
class Admission {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  explicit Admission(const AdmissionLimits& limits, Clock now = std::chrono::steady_clock::now)
      : limits_(limits), now_(std::move(now)) {}

  // The place that one request holds, until the ticket is destroyed or assigned to. A default ticket holds no place.
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

    // Adds points of the request when they are known. RESOURCE_EXHAUSTED: the points are beyond the limit, and the
    // ticket keeps what it had; see admit(). FAILED_PRECONDITION: the ticket holds no place.
    absl::Status add(std::uint64_t points);

   private:
    friend class Admission;
    Ticket(Admission* admission, std::uint64_t points) : admission_(admission), points_(points) {}

    Admission* admission_ = nullptr;
    std::uint64_t points_ = 0;
  };

  // Admits a request. RESOURCE_EXHAUSTED: it is beyond the limits; retry_after_ms() of the status says when to try
  // again.
  absl::StatusOr<Ticket> admit(std::uint64_t points = 0);
  // Counts a request without ever refusing it, for kinds of requests whose number another limit bounds.
  Ticket count(std::uint64_t points);

 private:
  bool has_room_for(std::uint64_t points) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::Status refusal() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Ticket take(std::uint64_t points) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void release(std::uint64_t points);

  const AdmissionLimits limits_;
  const Clock now_;
  base::Mutex mutex_;
  std::uint64_t requests_ ABSL_GUARDED_BY(mutex_) = 0, points_ ABSL_GUARDED_BY(mutex_) = 0;  // those at work
  // The work that has ended and the time it took, where older work counts less. The estimate of when to try again needs
  // their ratio.
  double recent_seconds_ ABSL_GUARDED_BY(mutex_) = 0, recent_work_ ABSL_GUARDED_BY(mutex_) = 0;
  // The time at which the work began, or at which the last request ended if that is later.
  std::chrono::steady_clock::time_point busy_since_ ABSL_GUARDED_BY(mutex_);
};

// Returns the number of milliseconds after which a client may send a request again that admission has refused with this
// status. Returns nothing for any other status.
std::optional<std::int64_t> retry_after_ms(const absl::Status& status);

}  // namespace isofield::rpc
