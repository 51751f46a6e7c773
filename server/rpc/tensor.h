// Reads the arrays of requests, checks them, and writes the arrays of responses.
#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "isofield/v1/scene.pb.h"
#include "rpc/shared_regions.h"

namespace isofield::rpc {

// Rows of numbers as float32. Numbers of a float32 tensor are used in place, those of a float64 tensor are converted.
class RowArray {
 public:
  // Errors speak of the tensor with these words.
  struct Words {
    const char* tensor;    // "points"
    const char* rows;      // "points"
    const char* too_many;  // what the client can do if it has more rows than are admitted
  };
  // Reads an array from bytes or from plain numbers. INVALID_ARGUMENT: its dtype, shape or size is wrong, or it has
  // more than kMaxNumberRows rows of plain numbers. RESOURCE_EXHAUSTED: it has more than max_rows. `tensor` must
  // outlive the result.
  static absl::StatusOr<RowArray> read(const v1::Tensor& tensor, std::uint64_t columns, std::uint64_t max_rows,
                                       const Words& words);

  // Reads an array in shared memory. The client may change it at any time, and numbers that are used in place change
  // then. Errors are the same, and those of SharedRegions::find.
  static absl::StatusOr<RowArray> read(const v1::SharedTensor& tensor, const SharedRegions& regions,
                                       std::uint64_t columns, std::uint64_t max_rows, const Words& words);

  std::span<const float> numbers() const { return numbers_; }

 private:
  using Shape = google::protobuf::RepeatedField<std::uint64_t>;
  // Checks everything except the bytes.
  static absl::Status check(v1::Tensor::DType dtype, const Shape& shape, std::uint64_t columns, std::uint64_t max_rows,
                            const Words& words);
  static absl::StatusOr<RowArray> read_numbers(const v1::Tensor& tensor, std::uint64_t columns, std::uint64_t max_rows,
                                               const Words& words);
  void convert(const std::byte* data, std::size_t count);  // from float64

  std::span<const float> numbers_;
  std::unique_ptr<float[]> converted_;
  std::shared_ptr<const void> region_;  // the region in which the numbers lie; null if they are elsewhere
};

// Points as rows of three float32 coordinates.
class PointArray {
 public:
  // Reads points. INVALID_ARGUMENT: the dtype, shape or size is wrong, or a coordinate is not finite.
  // RESOURCE_EXHAUSTED: there are more than max_points. `tensor` must outlive the result.
  static absl::StatusOr<PointArray> read(const v1::Tensor& tensor, std::uint64_t max_points,
                                         const RowArray::Words& words = {"points", "points",
                                                                         "send chunks by EvaluateStream"});
  // Reads points in shared memory. Coordinates are checked once; the client may change them later to others that are
  // not finite.
  static absl::StatusOr<PointArray> read(const v1::SharedTensor& tensor, const SharedRegions& regions,
                                         std::uint64_t max_points,
                                         const RowArray::Words& words = {"shared_points", "points",
                                                                         "send chunks by EvaluateStream"});

  std::span<const float> xyz() const { return rows_.numbers(); }
  std::size_t size() const { return xyz().size() / 3; }

 private:
  static absl::StatusOr<PointArray> of(absl::StatusOr<RowArray> rows, const RowArray::Words& words);

  RowArray rows_;
};

// Makes a FLOAT32 tensor of this shape and returns its numbers, which the caller must write.
std::span<float> make_float_tensor(std::initializer_list<std::uint64_t> shape, v1::Tensor& tensor);

// Turns the bytes of a tensor into plain numbers with the same values.
void write_as_numbers(v1::Tensor& tensor);
// Does the same for all tensors that are fields of an answer.
void write_tensors_as_numbers(google::protobuf::Message& answer);

// Fills a tensor with rows of `columns` numbers each.
void set_rows(std::span<const float> numbers, std::uint64_t columns, v1::Tensor& tensor);
void set_rows(std::span<const std::uint32_t> numbers, std::uint64_t columns, v1::Tensor& tensor);
void set_rows(std::span<const std::uint8_t> numbers, std::uint64_t columns, v1::Tensor& tensor);

}  // namespace isofield::rpc
