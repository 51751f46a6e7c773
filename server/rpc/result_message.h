// Makes EvaluateResponses in their encoded form, without a copy of the numbers.
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>

#include "engine/points/result_layout.h"

namespace isofield::rpc {

// Owns the numbers of a result. They are written once, into the memory that gRPC sends; a protobuf message would first
// fill its bytes with zeros and later copy them.
class ResultMessage {
 public:
  // Makes room for `rows` rows of the layout, one for each point. The numbers are undefined at first.
  ResultMessage(std::uint64_t rows, const engine::ResultLayout& layout);

  // Returns the size in bytes of a message with all rows.
  static std::uint64_t bytes(std::uint64_t rows, const engine::ResultLayout& layout, bool in_numbers);

  // Returns the numbers, to be written before take() or take_parts().
  std::span<float> numbers() { return {numbers_.get(), rows_ * columns_}; }
  // Returns the message with all rows, as bytes or as plain numbers. The message takes over the numbers, so that only
  // one call of take() or take_parts() is possible.
  grpc::ByteBuffer take(bool in_numbers);
  // Returns the rows as several messages of at most `most_rows` rows each, in order; without any rows there is one
  // message.
  std::deque<grpc::ByteBuffer> take_parts(std::uint64_t most_rows);

 private:
  std::uint64_t rows_, columns_;
  std::shared_ptr<float[]> numbers_;
};

// Returns an EvaluateResponse without a result, for results that went into shared memory.
grpc::ByteBuffer empty_result();

}  // namespace isofield::rpc
