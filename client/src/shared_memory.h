// Memory that the client shares with a daemon on the same machine, so that arrays need not travel through the
// connection. shared_memory.proto describes the protocol.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace isofield {

// One region of memory. The object owns it and the socket that keeps it shared, and frees both when it is destroyed. It
// cannot be moved or copied. Only one thread at a time may use it.
class SharedMemory {
 public:
  // Shares a new region of `bytes` bytes. `socket_path` is GetInfoResponse.shared_memory_socket. Errors are those of
  // the daemon, or UNAVAILABLE where the operating system fails or the daemon gives no proper answer.
  static absl::StatusOr<std::unique_ptr<SharedMemory>> open(const std::string& socket_path, std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  // Returns the name of the region in requests.
  const std::string& region() const { return region_; }
  std::byte* data() const { return data_; }
  // Returns false where the daemon is gone. A daemon that took its place does not know the region.
  bool is_alive() const;

 private:
  SharedMemory() = default;

  int socket_ = -1;
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
  std::string region_;
};

// Keeps a few regions for later evaluations. Any number of threads may use it at the same time.
class SharedMemoryPool {
 public:
  // Takes a region out of the pool. Returns null where the pool has none that a daemon knows.
  std::unique_ptr<SharedMemory> take();
  // Puts a region back, or frees it where the pool is full.
  void give(std::unique_ptr<SharedMemory> memory);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<SharedMemory>> kept_;
};

}  // namespace isofield
