// Arrays of requests and responses.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <span>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {

// Points as float32, in place where the tensor holds that and converted where it holds float64.
class PointArray {
 public:
  // INVALID_ARGUMENT: dtype, shape or size, or a coordinate that is not finite. RESOURCE_EXHAUSTED: more than
  // max_points. `tensor` must outlive the result.
  static absl::StatusOr<PointArray> read(const v1::Tensor& tensor, std::uint64_t max_points);

  std::span<const float> xyz() const { return xyz_; }
  std::size_t size() const { return xyz_.size() / 3; }

 private:
  std::span<const float> xyz_;
  std::vector<float> converted_;
};

// Makes a FLOAT32 tensor of this shape and returns its content, to be written by the caller.
std::span<float> make_float_tensor(std::initializer_list<std::uint64_t> shape, v1::Tensor& tensor);

}  // namespace isofield::rpc
