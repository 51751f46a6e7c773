#include "tensor.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>

#include <bit>

namespace isofield {
namespace {

// Bytes of a tensor are little-endian; they are taken as they are.
static_assert(std::endian::native == std::endian::little);

template <typename T>
absl::StatusOr<std::span<const T>> numbers_of(const v1::Tensor& tensor, v1::Tensor::DType dtype,
                                              std::uint64_t columns) {
  const std::string& data = tensor.data();
  // Divides rather than multiplies, so that no shape overflows.
  std::uint64_t left = data.size() / sizeof(T);
  bool fits = tensor.dtype() == dtype && data.size() % sizeof(T) == 0 && tensor.shape_size() > 0 &&
              tensor.shape(tensor.shape_size() - 1) == columns;
  for (int i = tensor.shape_size() - 1; fits && i >= 0 && left > 0; --i) {
    fits = tensor.shape(i) > 0 && left % tensor.shape(i) == 0;
    if (fits) left /= tensor.shape(i);
  }
  if (!fits || left > 1) {
    return absl::InternalError(absl::StrCat("the server sent a malformed array: dtype ", tensor.dtype(), ", shape [",
                                            absl::StrJoin(tensor.shape(), ", "), "], ", data.size(),
                                            " bytes; expected dtype ", dtype, " and ", columns, " columns"));
  }
  // The bytes of a string are aligned as these numbers need it, on the heap and within the string object.
  return std::span(reinterpret_cast<const T*>(data.data()), data.size() / sizeof(T));
}

template <typename T>
absl::Status append(const v1::Tensor& tensor, v1::Tensor::DType dtype, std::uint64_t columns, std::vector<T>& out) {
  const auto numbers = numbers_of<T>(tensor, dtype, columns);
  if (!numbers.ok()) return numbers.status();
  out.insert(out.end(), numbers->begin(), numbers->end());
  return absl::OkStatus();
}

}  // namespace

void set_floats(std::span<const float> numbers, std::uint64_t columns, v1::Tensor& tensor) {
  tensor.set_dtype(v1::Tensor::FLOAT32);
  tensor.clear_shape();
  tensor.add_shape(numbers.size() / columns);
  tensor.add_shape(columns);
  tensor.set_data(numbers.data(), numbers.size_bytes());
}

absl::StatusOr<std::span<const float>> floats_of(const v1::Tensor& tensor, std::uint64_t columns) {
  return numbers_of<float>(tensor, v1::Tensor::FLOAT32, columns);
}

absl::Status append_floats(const v1::Tensor& tensor, std::uint64_t columns, std::vector<float>& out) {
  return append(tensor, v1::Tensor::FLOAT32, columns, out);
}

absl::Status append_indices(const v1::Tensor& tensor, std::uint64_t columns, std::vector<std::uint32_t>& out) {
  return append(tensor, v1::Tensor::UINT32, columns, out);
}

absl::Status append_bytes(const v1::Tensor& tensor, std::uint64_t columns, std::vector<std::uint8_t>& out) {
  return append(tensor, v1::Tensor::UINT8, columns, out);
}

}  // namespace isofield
