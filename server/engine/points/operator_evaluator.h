// OperatorEvaluator computes values and partial derivatives of operators at given field values, on the device.
#pragma once

#include <absl/status/status.h>

#include <memory>
#include <span>

#include "engine/kernels/kernel_cache.h"
#include "engine/residency/volume_cache.h"
#include "gpu/device.h"
#include "operators/operator.h"

namespace isofield::engine {

// The number that steers an operator beside its fields: none, the opening angle theta, or the angle alpha between the
// gradients of its operands.
enum class Steering : std::uint32_t { kNone, kTheta, kAlpha };

// Thread-safe. What it is given must outlive it.
class OperatorEvaluator {
 public:
  OperatorEvaluator(gpu::Device& device, KernelCache& kernels, VolumeCache& volumes)
      : device_(device), kernels_(kernels), volumes_(volumes) {}

  // A row of `arguments` has `operands` field values; then theta or alpha (radians) if the operator is steered by it;
  // or the angle (radians) and the ratio of the lengths of two gradients if the operator follows their angle. A row of
  // `results` has g, its derivatives by the fields, and by theta or alpha if it steers. An operator of either law is
  // taken for positive fields.
  absl::Status evaluate(const std::shared_ptr<const operators::Operator>& op, std::size_t operands, Steering steering,
                        std::span<const float> arguments, std::span<float> results);
  // Evaluates an opening function at angles alpha, in radians. A row of `results` has theta and dtheta/dalpha.
  absl::Status evaluate_opening(const operators::Opening& opening, std::span<const float> alphas,
                                std::span<float> results);

 private:
  gpu::Device& device_;
  KernelCache& kernels_;
  VolumeCache& volumes_;
};

}  // namespace isofield::engine
