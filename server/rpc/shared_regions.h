// Memory that clients on this machine share with the server.
#pragma once

#include <absl/container/flat_hash_map.h>
#include <absl/status/statusor.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/mutex.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {

struct SharedLimits {
  std::uint64_t max_regions = 64;
  std::uint64_t max_bytes = 1u << 30;  // of all regions
};

// Part of a region, which lives as long. What it holds may change at any time.
struct SharedBytes {
  std::shared_ptr<const void> region;
  std::span<std::byte> bytes;
};

// Thread-safe.
class SharedRegions {
 public:
  explicit SharedRegions(const SharedLimits& limits) : limits_(limits) {}

  // Maps a memfd, which may be closed afterwards, and names it by 16 random bytes. INVALID_ARGUMENT: not a memfd that
  // keeps its size. RESOURCE_EXHAUSTED: beyond the limits.
  absl::StatusOr<std::string> open(int descriptor);
  // Unmapped when the requests that use it have ended.
  void close(const std::string& name);

  // `tensor` of `count` numbers of `number_bytes`; `what` it is in the request. Errors as SharedTensor's in
  // scene.proto, but for FAILED_PRECONDITION.
  absl::StatusOr<SharedBytes> find(const v1::SharedTensor& tensor, std::uint64_t count, std::uint64_t number_bytes,
                                   const char* what) const;

 private:
  struct Region;

  const SharedLimits limits_;
  mutable base::Mutex mutex_;
  absl::flat_hash_map<std::string, std::shared_ptr<Region>> regions_ ABSL_GUARDED_BY(mutex_);
  // Mapped: those closed and still in use among them. Shared with the regions.
  struct Usage {
    std::atomic<std::uint64_t> regions = 0, bytes = 0;
  };
  const std::shared_ptr<Usage> usage_ = std::make_shared<Usage>();
};

}  // namespace isofield::rpc
