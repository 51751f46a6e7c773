#include "operators/opening.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isofield::operators {
namespace {}  // namespace

Curve kappa(double x) {
  if (x <= 0) return {0, 0, 0};
  if (x >= 1) return {1, 0, 0};
  // kappa = 1 - exp(1 - 1/s) with s = 1 - e, e = exp(1 - 1/x). Written with 1 - 1/s = -e/s, small values are right to
  // the last bits. A small exponent w makes such small values visible.
  const double e = std::exp(1 - 1 / x);
  const double s = -std::expm1(1 - 1 / x);
  if (e == 0) return {0, 0, 0};
  if (s <= 0) return {1, 0, 0};
  return {-std::expm1(-e / s), std::exp(-e / s) * e / (x * x * s * s), 0};
}

Curve Opening::theta(double alpha) const {
  if (!samples.empty()) return samples.at(alpha);
  if (alpha <= alpha0) return {theta0, 0, 0};
  if (alpha >= alpha2) return {theta2, 0, 0};
  const bool rising = alpha > alpha1;
  const double span = rising ? alpha2 - alpha1 : alpha0 - alpha1;
  const double w = rising ? w1 : w0;
  const double far = rising ? theta2 : theta0;
  const Curve k = kappa((alpha - alpha1) / span);
  if (k.v <= 0) return {theta1, 0, 0};
  const double power = std::pow(k.v, w);
  return {power * (far - theta1) + theta1, w * power / k.v * k.d1 / span * (far - theta1), 0};
}

double Opening::theta_min() const {
  if (!samples.empty()) return samples.least();
  return std::min({theta0, theta1, theta2});
}

Opening Opening::turned() const {
  if (!samples.empty()) {
    Opening turned{};
    turned.samples = SampledCurve::even(0, std::numbers::pi, {samples.y().rbegin(), samples.y().rend()});
    return turned;
  }
  return {
      std::numbers::pi - alpha2, std::numbers::pi - alpha1, std::numbers::pi - alpha0, theta2, theta1, theta0, w1, w0};
}

double picked_opening(double f1, double f2) {
  return std::min(std::atan2(f2, f1), std::numbers::pi / 4);
}

Opening camel() {
  return {0, std::numbers::pi / 2, std::numbers::pi, std::numbers::pi / 4, 0, std::numbers::pi / 4, 1, 1};
}
Opening organic() {
  return {0, std::numbers::pi / 3, 3 * std::numbers::pi / 4, std::numbers::pi / 6, 0, std::numbers::pi / 4, 3, 1};
}
Opening contact() {
  return {0, std::numbers::pi / 2, std::numbers::pi, 0, std::numbers::pi / 10, std::numbers::pi / 4, 1, 0.7};
}

}  // namespace isofield::operators
