// Moves numbers into and out of v1::Tensor, the array of the gRPC messages.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield {

// Makes `tensor` the FLOAT32 array [numbers.size() / columns, columns].
void set_floats(std::span<const float> numbers, std::uint64_t columns, v1::Tensor& tensor);
// Makes `tensor` the FLOAT32 array [n, 3] of points.
inline void set_points(std::span<const float> xyz, v1::Tensor& tensor) {
  set_floats(xyz, 3, tensor);
}

// Returns a view of the numbers in the message; `columns` is the last dimension of the array.
// INTERNAL: the type, the shape and the bytes do not fit each other or the expectation.
absl::StatusOr<std::span<const float>> floats_of(const v1::Tensor& tensor, std::uint64_t columns);
// These append the numbers to `out`. The array must be of FLOAT32, UINT32 and UINT8, in this order; errors as above.
absl::Status append_floats(const v1::Tensor& tensor, std::uint64_t columns, std::vector<float>& out);
absl::Status append_indices(const v1::Tensor& tensor, std::uint64_t columns, std::vector<std::uint32_t>& out);
absl::Status append_bytes(const v1::Tensor& tensor, std::uint64_t columns, std::vector<std::uint8_t>& out);

}  // namespace isofield
