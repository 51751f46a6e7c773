// Tests arrays in requests and answers that are plain numbers instead of bytes.
#include "rpc/tensor.h"

#include <gtest/gtest.h>

#include <limits>

#include "rpc/answer_limit.h"

namespace isofield::rpc {
namespace {

constexpr RowArray::Words kWords{"points", "points", "send several requests"};

v1::Tensor tensor(std::initializer_list<double> numbers, std::initializer_list<std::uint64_t> shape = {},
                  v1::Tensor::DType dtype = v1::Tensor::DTYPE_UNSPECIFIED) {
  v1::Tensor tensor;
  tensor.set_dtype(dtype);
  for (const std::uint64_t n : shape) tensor.add_shape(n);
  for (const double x : numbers) tensor.add_numbers(x);
  return tensor;
}

absl::Status refused(const v1::Tensor& tensor) {
  return RowArray::read(tensor, 3, 1 << 20, kWords).status();
}

TEST(NumberRows, AreReadWithOrWithoutTypeAndShape) {
  for (const v1::Tensor& t : {tensor({0, 0.5, -1, 1, 2, 3}), tensor({0, 0.5, -1, 1, 2, 3}, {2, 3}),
                              tensor({0, 0.5, -1, 1, 2, 3}, {}, v1::Tensor::FLOAT32),
                              tensor({0, 0.5, -1, 1, 2, 3}, {2, 3}, v1::Tensor::FLOAT64)}) {
    const auto array = RowArray::read(t, 3, 1 << 20, kWords);
    ASSERT_TRUE(array.ok()) << array.status();
    EXPECT_EQ(std::vector<float>(array->numbers().begin(), array->numbers().end()),
              (std::vector<float>{0, 0.5, -1, 1, 2, 3}));
  }
}

TEST(NumberRows, AreRefusedByTheNameOfTheirField) {
  const struct {
    v1::Tensor tensor;
    const char* message;
  } kBad[] = {
      {tensor({1, 2, 3, 4}), "points.numbers holds 4 numbers: expected a multiple of 3"},
      {tensor({1, 2, 3}, {2, 3}), "points.numbers holds 3 numbers: expected 6 for 2 points"},
      {tensor({1, 2, 3}, {0x5555555555555556ull - 1, 3}), "points.shape"},
      {tensor({1, 2, 3}, {3}), "points.shape = [3]: expected [n, 3]"},
      {tensor({1, 2, 3}, {1, 3}, v1::Tensor::UINT8), "points.dtype = UINT8: expected FLOAT32 or FLOAT64"},
  };
  for (const auto& bad : kBad) {
    EXPECT_NE(refused(bad.tensor).message().find(bad.message), std::string::npos) << refused(bad.tensor);
  }
  v1::Tensor both = tensor({1, 2, 3});
  both.set_data(std::string(12, '\0'));
  EXPECT_NE(refused(both).message().find("points.data and points.numbers are both stated"), std::string::npos);
  EXPECT_EQ(refused(both).code(), absl::StatusCode::kInvalidArgument);
}

TEST(NumberRows, AreAtMost4096) {
  v1::Tensor most;
  most.mutable_numbers()->Resize(3 * 4096, 1.0);
  EXPECT_TRUE(refused(most).ok());
  most.mutable_numbers()->Resize(3 * 4097, 1.0);
  EXPECT_EQ(refused(most).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(refused(most).message().find("points.numbers holds 4097 points: expected at most 4096"), std::string::npos);
  EXPECT_TRUE(check_number_rows(true, 4096).ok());
  EXPECT_TRUE(check_number_rows(false, 4097).ok());
  EXPECT_EQ(check_number_rows(true, 4097).code(), absl::StatusCode::kInvalidArgument);
}

TEST(NumberRows, CoordinatesThatAreNotFiniteAreNamed) {
  const auto points = PointArray::read(tensor({0, 0, 0, 1, 1e300, 0}), 1 << 20);
  EXPECT_NE(points.status().message().find("points[1].y = inf"), std::string::npos) << points.status();
}

TEST(NumberRows, AnswersSayTheSameAsTheirBytes) {
  const float infinity = std::numeric_limits<float>::infinity();
  v1::Tensor floats, indices, bytes;
  set_rows(std::vector<float>{0.1f, infinity, -3}, 3, floats);
  set_rows(std::vector<std::uint32_t>{7, ~0u}, 1, indices);
  set_rows(std::vector<std::uint8_t>{1, 0, 255}, 1, bytes);
  for (v1::Tensor* t : {&floats, &indices, &bytes}) {
    write_as_numbers(*t);
    EXPECT_TRUE(t->data().empty());
    EXPECT_EQ(t->shape_size(), 2);
  }
  EXPECT_EQ(std::vector<double>(floats.numbers().begin(), floats.numbers().end()),
            (std::vector<double>{0.1f, infinity, -3}));
  EXPECT_EQ(std::vector<double>(indices.numbers().begin(), indices.numbers().end()),
            (std::vector<double>{7, 4294967295.0}));
  EXPECT_EQ(std::vector<double>(bytes.numbers().begin(), bytes.numbers().end()), (std::vector<double>{1, 0, 255}));
}

}  // namespace
}  // namespace isofield::rpc
