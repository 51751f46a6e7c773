// Serves FieldService.Evaluate with a few threads, however many calls wait.
#pragma once

#include <memory>

#include "rpc/call_threads.h"
#include "rpc/field_service.h"

namespace isofield::rpc {

// Each of gRPC's synchronous calls would hold a thread, and waking a thread for every answer of a joined submission
// takes longer than the submission. Here the thread that ends a submission sends all its answers. A thread that makes a
// scene resident, compiles a kernel, or evaluates a large batch serves no other call meanwhile.
class EvaluateCalls {
 public:
  EvaluateCalls(FieldService& service, std::unique_ptr<grpc::ServerCompletionQueue> queue)
      : service_(service), threads_(std::move(queue)) {}

  // See CallThreads for when these may be called.
  void start(int threads);
  void stop() { threads_.stop(); }

 private:
  class Call;

  FieldService& service_;
  CallThreads threads_;
};

}  // namespace isofield::rpc
