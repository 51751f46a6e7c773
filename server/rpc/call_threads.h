// Few threads that serve any number of asynchronous calls.
#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "base/mutex.h"

namespace isofield::rpc {

class CallThreads {
 public:
  // `queue`: the server's own for this.
  explicit CallThreads(std::unique_ptr<grpc::ServerCompletionQueue> queue) : queue_(std::move(queue)) {}
  ~CallThreads() { stop(); }

  // The tag of an operation: what is done when gRPC gives it back.
  using Event = std::function<void(bool is_ok)>;
  grpc::ServerCompletionQueue* queue() { return queue_.get(); }

  // A part of every call, the one wished for among them: stop() waits until all are gone.
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

  // Once the server is started, and the first call is wished for.
  void start(int threads);
  // Once the server is shut down; waits for the calls.
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
