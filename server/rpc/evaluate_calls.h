// FieldService.Evaluate as it is served: by few threads for any number of calls that wait.
#pragma once

#include <memory>

#include "rpc/call_threads.h"
#include "rpc/field_service.h"

namespace isofield::rpc {

// gRPC's synchronous calls hold a thread each, and to wake one for every answer of a joined submission takes longer
// than the submission. Here the thread that ends a submission sends all its answers. A thread that makes a scene
// resident, compiles a kernel, or evaluates a large batch is taken for as long.
class EvaluateCalls {
 public:
  EvaluateCalls(FieldService& service, std::unique_ptr<grpc::ServerCompletionQueue> queue)
      : service_(service), threads_(std::move(queue)) {}

  // As of CallThreads.
  void start(int threads);
  void stop() { threads_.stop(); }

 private:
  class Call;

  FieldService& service_;
  CallThreads threads_;
};

}  // namespace isofield::rpc
