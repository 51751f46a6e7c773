// Values and partial derivatives of operators at given field values.
#pragma once

#include <absl/status/status.h>

#include <span>

#include "operators/operator.h"

namespace isofield::engine {

enum class Steering { kNone, kTheta, kAlpha };

// Thread-safe.
class OperatorEvaluator {
 public:
  // arguments: rows of field values [, theta or alpha [, ratio]]; results: rows of g, dg/df1 ... [, dg/dsteering].
  absl::Status evaluate(const operators::Operator& op, Steering steering, std::span<const float> arguments,
                        std::span<float> results);
  // results: rows of theta, dtheta/dalpha.
  absl::Status evaluate_opening(const operators::Opening& opening, std::span<const float> alphas,
                                std::span<float> results);
};

}  // namespace isofield::engine
