// EvaluateResponses in the bytes that travel.
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>

namespace isofield::rpc {

// Results are written once, into what gRPC sends: a message of protobuf's would fill its bytes with zeros before and
// copy them after.
class ResultMessage {
 public:
  // `result` of shape [rows, columns], undefined as yet.
  ResultMessage(std::uint64_t rows, std::uint64_t columns);

  // Bytes of the message of all rows.
  static std::uint64_t bytes(std::uint64_t rows, std::uint64_t columns, bool in_numbers);

  std::span<float> numbers() { return {numbers_.get(), rows_ * columns_}; }
  // The message of all rows, which takes the numbers with it.
  grpc::ByteBuffer take(bool in_numbers);
  // The same in several messages of at most so many rows each, in order; in one where there are no rows.
  std::deque<grpc::ByteBuffer> take_parts(std::uint64_t most_rows);

 private:
  std::uint64_t rows_, columns_;
  std::shared_ptr<float[]> numbers_;
};

// A response without a result.
grpc::ByteBuffer empty_result();

}  // namespace isofield::rpc
