#include "rpc/tensor.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace isofield::rpc {
namespace {

static_assert(std::endian::native == std::endian::little, "tensors are little-endian");

// The place of the first number that is not finite, or the size. Branch-free over blocks, so that it vectorises.
template <class T>
std::size_t first_not_finite(std::span<const T> numbers) {
  constexpr std::size_t kBlock = 256;
  for (std::size_t at = 0; at < numbers.size(); at += kBlock) {
    const auto block = numbers.subspan(at, std::min(kBlock, numbers.size() - at));
    T sum = 0;  // 0 * x is NaN for infinities and NaN
    for (const T x : block) sum += x * 0;
    if (sum == 0) continue;
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (!std::isfinite(block[i])) return at + i;
    }
  }
  return numbers.size();
}

}  // namespace

absl::StatusOr<PointArray> PointArray::read(const v1::Tensor& tensor, std::uint64_t max_points) {
  if (tensor.dtype() != v1::Tensor::FLOAT32 && tensor.dtype() != v1::Tensor::FLOAT64) {
    const std::string& name = v1::Tensor::DType_Name(tensor.dtype());  // empty: a number that has none
    return absl::InvalidArgumentError(absl::StrCat(
        "points.dtype = ", name.empty() ? absl::StrCat(tensor.dtype()) : name, ": expected FLOAT32 or FLOAT64"));
  }
  if (tensor.shape_size() != 2 || tensor.shape(1) != 3) {
    return absl::InvalidArgumentError(
        absl::StrCat("points.shape = [", absl::StrJoin(tensor.shape(), ", "), "]: expected [n, 3]"));
  }
  const std::uint64_t count = tensor.shape(0);
  if (count > max_points) {
    return absl::ResourceExhaustedError(absl::StrCat("points.shape = [", count, ", 3]: at most ", max_points,
                                                     " points a message; send chunks by EvaluateStream"));
  }
  const std::uint64_t size = tensor.dtype() == v1::Tensor::FLOAT32 ? 4 : 8;
  if (tensor.data().size() != 3 * size * count) {
    return absl::InvalidArgumentError(absl::StrCat("points.data holds ", tensor.data().size(), " bytes: expected ",
                                                   3 * size * count, " for ", count, " points of 3 x ", size,
                                                   " bytes"));
  }
  PointArray array;
  if (size == 4) {
    array.xyz_ = {reinterpret_cast<const float*>(tensor.data().data()), 3 * count};
  } else {
    array.converted_.resize(3 * count);
    const auto* doubles = reinterpret_cast<const double*>(tensor.data().data());
    for (std::size_t i = 0; i < 3 * count; ++i) array.converted_[i] = static_cast<float>(doubles[i]);
    array.xyz_ = array.converted_;
  }
  const std::size_t bad = first_not_finite(array.xyz_);
  if (bad < array.xyz_.size()) {
    return absl::InvalidArgumentError(absl::StrCat("points[", bad / 3, "].", std::string(1, "xyz"[bad % 3]), " = ",
                                                   array.xyz_[bad], ": expected a finite float32"));
  }
  return array;
}

std::span<float> make_float_tensor(std::initializer_list<std::uint64_t> shape, v1::Tensor& tensor) {
  tensor.set_dtype(v1::Tensor::FLOAT32);
  std::uint64_t count = 1;
  for (const std::uint64_t n : shape) {
    tensor.add_shape(n);
    count *= n;
  }
  std::string* data = tensor.mutable_data();
  data->resize(4 * count);
  return {reinterpret_cast<float*>(data->data()), count};
}

}  // namespace isofield::rpc
