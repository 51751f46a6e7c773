// Maps memory that clients on this machine share with the server, and finds arrays in it.
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
  std::uint64_t max_bytes = 1u << 30;  // the bytes of all regions together
};

// A part of a region, which stays mapped as long as this lives. The client may change the bytes at any time.
struct SharedBytes {
  std::shared_ptr<const void> region;
  std::span<std::byte> bytes;
};

// Owns the mappings of all open regions. Thread-safe.
class SharedRegions {
 public:
  explicit SharedRegions(const SharedLimits& limits) : limits_(limits) {}

  // Maps a memfd, which may be closed afterwards, and returns its name, 16 random bytes. INVALID_ARGUMENT: the
  // descriptor is not a memfd whose size is sealed, or it is empty. RESOURCE_EXHAUSTED: the region is beyond the
  // limits, or cannot be mapped.
  absl::StatusOr<std::string> open(int descriptor);
  // Forgets a region. It is unmapped when all requests that use it have ended.
  void close(const std::string& name);

  // Finds the array of `count` numbers of `number_bytes` each that `tensor` refers to. Errors call it `what`, and are
  // those of SharedTensor in scene.proto except for FAILED_PRECONDITION.
  absl::StatusOr<SharedBytes> find(const v1::SharedTensor& tensor, std::uint64_t count, std::uint64_t number_bytes,
                                   const char* what) const;

 private:
  struct Region;

  const SharedLimits limits_;
  mutable base::Mutex mutex_;
  absl::flat_hash_map<std::string, std::shared_ptr<Region>> regions_ ABSL_GUARDED_BY(mutex_);
  // The regions that are mapped, including closed ones that are still in use. The regions share this count, since they
  // may outlive this.
  struct Usage {
    std::atomic<std::uint64_t> regions = 0, bytes = 0;
  };
  const std::shared_ptr<Usage> usage_ = std::make_shared<Usage>();
};

}  // namespace isofield::rpc
