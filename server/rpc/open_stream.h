// Counts the streams that are open: each holds a thread of the server.
#pragma once

#include <atomic>

namespace isofield::rpc {

// Counted while it lives.
class OpenStream {
 public:
  explicit OpenStream(std::atomic<int>& counter) : counter_(counter), count_(++counter) {}
  ~OpenStream() { --counter_; }
  OpenStream(const OpenStream&) = delete;
  OpenStream& operator=(const OpenStream&) = delete;
  // With this one.
  int count() const { return count_; }

 private:
  std::atomic<int>& counter_;
  const int count_;
};

}  // namespace isofield::rpc
