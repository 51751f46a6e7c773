// Serves any number of asynchronous gRPC calls with a few threads, which work through a completion queue.
#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "base/mutex.h"

namespace isofield::rpc {

// Owns the queue and the threads. A call is an object with a Member; it gives gRPC pointers to Events as tags, and one
// of the threads calls the Event when its operation is done.
class CallThreads {
 public:
  // `queue` is a completion queue of the server that only this object works through.
  explicit CallThreads(std::unique_ptr<grpc::ServerCompletionQueue> queue) : queue_(std::move(queue)) {}
  ~CallThreads() { stop(); }

  // The tag of an operation is a pointer to an Event, which is called when gRPC gives the tag back.
  using Event = std::function<void(bool is_ok)>;
  grpc::ServerCompletionQueue* queue() { return queue_.get(); }

  // Every call has a Member, also one that has not come yet. stop() waits until all Members are destroyed.
  class Member {
   public:
    explicit Member(CallThreads& threads) : threads_(threads) {
      const base::MutexLock lock(threads_.mutex_);
      ++threads_.calls_;
    }
    ~Member() {
      const base::MutexLock lock(threads_.mutex_);
      if (--threads_.calls_ == 0) threads_.none_left_.notify_one();
    }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

   private:
    CallThreads& threads_;
  };

  // Starts the threads. The server must have started, and gRPC must have been asked for the first call.
  void start(int threads);
  // Waits for all calls, and ends the threads. The server must have been shut down.
  void stop();

 private:
  void serve();

  std::unique_ptr<grpc::ServerCompletionQueue> queue_;
  std::vector<std::thread> threads_;
  base::Mutex mutex_;
  std::size_t calls_ ABSL_GUARDED_BY(mutex_) = 0;
  base::Condition none_left_;
};

}  // namespace isofield::rpc
