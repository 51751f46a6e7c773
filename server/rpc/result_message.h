// EvaluateResponses in their encoded form, made without a copy of the numbers.
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>

#include "engine/points/result_layout.h"

namespace isofield::rpc {

// Results are written once, into what gRPC sends: a message of protobuf's would fill its bytes with zeros before and
// copy them after.
class ResultMessage {
 public:
  // `result` has a row of the layout a point, undefined as yet.
  ResultMessage(std::uint64_t rows, const engine::ResultLayout& layout);

  // The size in bytes of the message with all rows.
  static std::uint64_t bytes(std::uint64_t rows, const engine::ResultLayout& layout, bool in_numbers);

  std::span<float> numbers() { return {numbers_.get(), rows_ * columns_}; }
  // The message with all rows. It takes over the numbers, so that it can be asked for only once.
  grpc::ByteBuffer take(bool in_numbers);
  // The same as several messages of at most so many rows each, in order; without any rows it is one message.
  std::deque<grpc::ByteBuffer> take_parts(std::uint64_t most_rows);

 private:
  std::uint64_t rows_, columns_;
  std::shared_ptr<float[]> numbers_;
};

// A response without a result.
grpc::ByteBuffer empty_result();

}  // namespace isofield::rpc
