#include "engine/operator_evaluator.h"

#include <algorithm>

#include "operators/gradient_blend.h"

namespace isofield::engine {

// A stand-in until operators are evaluated on the device.
absl::Status OperatorEvaluator::evaluate(const operators::Operator& op, Steering steering,
                                         std::span<const float> arguments, std::span<float> results) {
  const std::size_t fields = op.kind == operators::Kind::kBtk && op.terms.size() > 1 ? op.terms.size() : 2;
  const bool has_ratio = op.by_angle;
  const std::size_t in = fields + (steering != Steering::kNone) + has_ratio;
  const std::size_t out = 1 + fields + (steering != Steering::kNone);
  for (std::size_t row = 0; row * in < arguments.size(); ++row) {
    const float* a = &arguments[row * in];
    float* r = &results[row * out];
    std::fill(r, r + out, 0.0f);
    if (op.kind == operators::Kind::kGradient || op.kind == operators::Kind::kSampled) {
      double theta = a[2], slope = 1;
      if (steering == Steering::kAlpha) {
        const operators::Curve curve = op.opening.theta(a[2]);
        theta = curve.v;
        slope = curve.d1;
      }
      const operators::Blend b =
          operators::gradient_blend(a[0], a[1], std::min(theta, 0.7853981633974483), op.silhouette);
      r[0] = b.g, r[1] = b.g1, r[2] = b.g2, r[3] = b.gt * slope;
    } else {
      const bool is_least = op.kind == operators::Kind::kMin || op.kind == operators::Kind::kBt2;
      const auto best = is_least ? std::min_element(a, a + fields) : std::max_element(a, a + fields);
      r[0] = *best;
      r[1 + (best - a)] = 1;
    }
  }
  return absl::OkStatus();
}

absl::Status OperatorEvaluator::evaluate_opening(const operators::Opening& opening, std::span<const float> alphas,
                                                 std::span<float> results) {
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const operators::Curve curve = opening.theta(alphas[i]);
    results[2 * i] = curve.v;
    results[2 * i + 1] = curve.d1;
  }
  return absl::OkStatus();
}

}  // namespace isofield::engine
