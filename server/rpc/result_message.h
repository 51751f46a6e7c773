// An EvaluateResponse in the bytes that travel.
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <memory>
#include <span>

namespace isofield::rpc {

// Results are written once, into what gRPC sends: a message of protobuf's would fill its bytes with zeros before and
// copy them after.
class ResultMessage {
 public:
  // `result` of shape [rows, columns], undefined as yet.
  ResultMessage(std::uint64_t rows, std::uint64_t columns);

  std::span<float> numbers() { return {numbers_.get(), rows_ * columns_}; }
  // The message, which takes the numbers with it.
  grpc::ByteBuffer take();

 private:
  std::uint64_t rows_, columns_;
  std::unique_ptr<float[]> numbers_;
};

}  // namespace isofield::rpc
