// Serves FieldService.EvaluateStream: while one message of a stream is evaluated, the next one is read and the answer
// to the previous one is written.
#pragma once

#include <atomic>
#include <memory>

#include "rpc/call_threads.h"
#include "rpc/field_service.h"

namespace isofield::rpc {

// A stream uses a thread only while one of its messages is parsed or evaluated. A few messages of each stream are in
// work at a time, so that one can be decoded and one written while the device works on a third.
class EvaluateStreams {
 public:
  EvaluateStreams(FieldService& service, std::unique_ptr<grpc::ServerCompletionQueue> queue)
      : service_(service), threads_(std::move(queue)) {}

  // See CallThreads for when these may be called.
  void start(int threads);
  void stop() { threads_.stop(); }

 private:
  class Stream;

  FieldService& service_;
  std::atomic<int> open_ = 0;  // streams that are open
  CallThreads threads_;
};

}  // namespace isofield::rpc
