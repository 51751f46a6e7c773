#include "rpc/result_message.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/slice.h>

#include <array>
#include <string>

#include "isofield/v1/field_service.pb.h"

namespace isofield::rpc {
namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedOutputStream;

// Tag and length of a field whose content follows.
std::string field_head(int number, std::uint64_t bytes) {
  std::array<std::uint8_t, 16> head;
  std::uint8_t* end = CodedOutputStream::WriteVarint32ToArray(
      WireFormatLite::MakeTag(number, WireFormatLite::WIRETYPE_LENGTH_DELIMITED), head.data());
  end = CodedOutputStream::WriteVarint64ToArray(bytes, end);
  return {head.data(), end};
}

}  // namespace

ResultMessage::ResultMessage(std::uint64_t rows, std::uint64_t columns)
    : rows_(rows), columns_(columns), numbers_(std::make_unique_for_overwrite<float[]>(rows * columns)) {}

grpc::ByteBuffer ResultMessage::take() {
  const std::size_t bytes = numbers().size_bytes();
  v1::Tensor tensor;
  tensor.set_dtype(v1::Tensor::FLOAT32);
  tensor.add_shape(rows_);
  tensor.add_shape(columns_);
  const std::string inner = tensor.SerializeAsString() + field_head(v1::Tensor::kDataFieldNumber, bytes);
  const std::string head = field_head(v1::EvaluateResponse::kResultFieldNumber, inner.size() + bytes) + inner;
  float* const numbers = numbers_.release();
  const std::array slices{grpc::Slice(head),
                          grpc::Slice(numbers, bytes, [](void* p) { delete[] static_cast<float*>(p); })};
  return {slices.data(), slices.size()};
}

}  // namespace isofield::rpc
