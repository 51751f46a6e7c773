// FieldService.Evaluate as it is served: by few threads for any number of calls that wait.
#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "rpc/field_service.h"

namespace isofield::rpc {

// gRPC's synchronous calls hold a thread each, and to wake one for every answer of a joined submission takes longer
// than the submission. Here the thread that ends a submission sends all its answers. A thread that makes a scene
// resident, compiles a kernel, or evaluates a large batch is taken for as long.
class EvaluateCalls {
 public:
  // `queue`: the server's own for this.
  EvaluateCalls(FieldService& service, std::unique_ptr<grpc::ServerCompletionQueue> queue)
      : service_(service), queue_(std::move(queue)) {}
  ~EvaluateCalls() { stop(); }

  // Once the server is started.
  void start(int threads);
  // Once the server is shut down; waits for the calls.
  void stop();

 private:
  class Call;
  // What gRPC gives back when something of a call is done.
  struct Event {
    void (Call::*happened)(bool is_ok);
    Call* call;
  };
  void serve();

  FieldService& service_;
  std::unique_ptr<grpc::ServerCompletionQueue> queue_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::size_t calls_ = 0;  // that there are, the one wished for among them
  std::condition_variable none_left_;
};

}  // namespace isofield::rpc
