// FieldService.EvaluateStream as it is served: a stream's messages are read, evaluated and answered at the same time.
#pragma once

#include <atomic>
#include <memory>

#include "rpc/call_threads.h"
#include "rpc/field_service.h"

namespace isofield::rpc {

// A stream holds no thread, only while a message of it is read from its bytes and evaluated; of each, so many messages
// are at hand that one can be decoded and one written while the device is at a third.
class EvaluateStreams {
 public:
  EvaluateStreams(FieldService& service, std::unique_ptr<grpc::ServerCompletionQueue> queue)
      : service_(service), threads_(std::move(queue)) {}

  // As of CallThreads.
  void start(int threads);
  void stop() { threads_.stop(); }

 private:
  class Stream;

  FieldService& service_;
  std::atomic<int> open_ = 0;
  CallThreads threads_;
};

}  // namespace isofield::rpc
