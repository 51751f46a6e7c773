#include "rpc/result_message.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/slice.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "isofield/v1/field_service.pb.h"

namespace isofield::rpc {
namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedOutputStream;

// Returns the tag and the length of a field whose content follows.
std::string field_head(int number, std::uint64_t bytes) {
  std::array<std::uint8_t, 16> head;
  std::uint8_t* end = CodedOutputStream::WriteVarint32ToArray(
      WireFormatLite::MakeTag(number, WireFormatLite::WIRETYPE_LENGTH_DELIMITED), head.data());
  end = CodedOutputStream::WriteVarint64ToArray(bytes, end);
  return {head.data(), end};
}

// Returns the bytes of a message that come before its numbers.
std::string message_head(std::uint64_t rows, std::uint64_t columns, bool in_numbers) {
  const std::uint64_t bytes = rows * columns * (in_numbers ? sizeof(double) : sizeof(float));
  v1::Tensor tensor;
  tensor.set_dtype(v1::Tensor::FLOAT32);
  tensor.add_shape(rows);
  tensor.add_shape(columns);
  const std::string inner =
      tensor.SerializeAsString() +
      field_head(in_numbers ? v1::Tensor::kNumbersFieldNumber : v1::Tensor::kDataFieldNumber, bytes);
  return field_head(v1::EvaluateResponse::kResultFieldNumber, inner.size() + bytes) + inner;
}

}  // namespace

ResultMessage::ResultMessage(std::uint64_t rows, const engine::ResultLayout& layout)
    : rows_(rows),
      columns_(layout.numbers()),
      numbers_(std::make_shared_for_overwrite<float[]>(layout.numbers(rows))) {}

std::uint64_t ResultMessage::bytes(std::uint64_t rows, const engine::ResultLayout& layout, bool in_numbers) {
  return message_head(rows, layout.numbers(), in_numbers).size() +
         layout.numbers(rows) * (in_numbers ? sizeof(double) : sizeof(float));
}

grpc::ByteBuffer ResultMessage::take(bool in_numbers) {
  if (!in_numbers) return take_parts(rows_).front();
  const std::vector<double> wide(numbers_.get(), numbers_.get() + rows_ * columns_);
  numbers_.reset();
  const std::array slices{grpc::Slice(message_head(rows_, columns_, true)),
                          grpc::Slice(wide.data(), wide.size() * sizeof(double))};
  return {slices.data(), slices.size()};
}

std::deque<grpc::ByteBuffer> ResultMessage::take_parts(std::uint64_t most_rows) {
  using Owner = std::shared_ptr<float[]>;
  std::deque<grpc::ByteBuffer> messages;
  std::uint64_t first = 0;
  do {
    const std::uint64_t rows = std::min(most_rows, rows_ - first);
    const std::array slices{grpc::Slice(message_head(rows, columns_, false)),
                            grpc::Slice(
                                numbers_.get() + first * columns_, rows * columns_ * sizeof(float),
                                [](void* owner) { delete static_cast<Owner*>(owner); }, new Owner(numbers_))};
    messages.emplace_back(slices.data(), slices.size());
    first += rows;
  } while (first < rows_);
  numbers_.reset();
  return messages;
}

grpc::ByteBuffer empty_result() {
  const grpc::Slice nothing;
  return {&nothing, 1};
}

}  // namespace isofield::rpc
