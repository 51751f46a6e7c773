// Values and partial derivatives of operators at given field values, on the device.
#pragma once

#include <absl/status/status.h>

#include <memory>
#include <span>

#include "engine/kernels/kernel_cache.h"
#include "engine/residency/volume_cache.h"
#include "gpu/device.h"
#include "operators/operator.h"

namespace isofield::engine {

// What steers an operator beside its fields.
enum class Steering : std::uint32_t { kNone, kTheta, kAlpha };

// Thread-safe.
class OperatorEvaluator {
 public:
  OperatorEvaluator(gpu::Device& device, KernelCache& kernels, VolumeCache& volumes)
      : device_(device), kernels_(kernels), volumes_(volumes) {}

  // arguments: rows of `operands` field values, theta or alpha where the operator is steered by one (radians), and, for
  // operators that follow the angle of two gradients, the ratio of their lengths; results: rows of g, its derivatives
  // by the fields, and by theta or alpha. An operator of either law is taken for positive fields.
  absl::Status evaluate(const std::shared_ptr<const operators::Operator>& op, std::size_t operands, Steering steering,
                        std::span<const float> arguments, std::span<float> results);
  // results: rows of theta, dtheta/dalpha.
  absl::Status evaluate_opening(const operators::Opening& opening, std::span<const float> alphas,
                                std::span<float> results);

 private:
  gpu::Device& device_;
  KernelCache& kernels_;
  VolumeCache& volumes_;
};

}  // namespace isofield::engine
