#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace isofield {

// Memory shared with a daemon on this machine (shared_memory.proto) for as long as this lives. Movable through a
// pointer alone; one thread at a time.
class SharedMemory {
 public:
  // `socket_path`: GetInfoResponse.shared_memory_socket. Errors: the daemon's, or what the system says.
  static absl::StatusOr<std::unique_ptr<SharedMemory>> open(const std::string& socket_path, std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  // Its name in requests.
  const std::string& region() const { return region_; }
  std::byte* data() const { return data_; }
  // False: the daemon is gone, and one that took its place does not know the region.
  bool is_alive() const;

 private:
  SharedMemory() = default;

  int socket_ = -1;
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
  std::string region_;
};

// What is kept for the next evaluation. Any number of threads.
class SharedMemoryPool {
 public:
  // Null: there is none that a daemon knows.
  std::unique_ptr<SharedMemory> take();
  void give(std::unique_ptr<SharedMemory> memory);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<SharedMemory>> kept_;
};

}  // namespace isofield
