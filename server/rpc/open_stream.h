// Counts open streams, so that their number can be limited: each holds a thread of the server.
#pragma once

#include <atomic>

namespace isofield::rpc {

// Adds 1 to the counter, and takes it away at its destruction. `counter` must outlive it.
class OpenStream {
 public:
  explicit OpenStream(std::atomic<int>& counter) : counter_(counter), count_(++counter) {}
  ~OpenStream() { --counter_; }
  OpenStream(const OpenStream&) = delete;
  OpenStream& operator=(const OpenStream&) = delete;
  // Returns the number of streams that were open at its construction, this one included.
  int count() const { return count_; }

 private:
  std::atomic<int>& counter_;
  const int count_;
};

}  // namespace isofield::rpc
