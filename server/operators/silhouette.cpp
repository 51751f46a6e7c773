#include "operators/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "operators/root.h"

namespace isofield::operators {
namespace {

// Returns the upper half y(x) of a silhouette, where y >= x, for x within [0, 1].
Curve upper_half(const Silhouette& s, double x) {
  if (s.kind == Silhouette::Kind::kSmooth) {
    const Curve e = smooth_step_e(x);
    return {1 - e.v, -e.d1, -e.d2};
  }
  // This is [G] eq. 31 with its two cases in the right order: y = 1 - K exp(1 - 1/x) (1 - x).
  const double e = x > 0 ? s.k * std::exp(1 - 1 / x) : 0;
  if (e == 0) return {1, 0, 0};
  const double x2 = x * x;
  const double slope = (1 - x) / x2 - 1;
  return {1 - e * (1 - x), -e * slope, -e * (slope / x2 - 1 / x2 - 2 * (1 - x) / (x2 * x))};
}

// Returns q = 1 / (s cos w) on the ray at the angle w = atan(u) from the half's axis.
Curve sampled_profile(const SampledCurve& samples, double u, Silhouette::Half half) {
  const bool is_second = half == Silhouette::Half::kSecond;
  const double w = std::atan(u), cos2 = 1 / (1 + u * u);
  Curve s = samples.at(is_second ? std::numbers::pi / 2 - w : w);
  if (is_second) s.d1 = -s.d1;
  const double q = 1 / (s.v * std::sqrt(cos2));
  const double fall = s.d1 / s.v;
  const double q_w = q * (u - fall);
  const double q_ww = q_w * (u - fall) + q * (1 / cos2 - s.d2 / s.v + fall * fall);
  return {q, q_w * cos2, cos2 * cos2 * (q_ww - 2 * u * q_w)};
}

}  // namespace

Curve smooth_step_e(double x) {
  constexpr double e = std::numbers::e;
  const double a = std::exp(e * (1 - x));
  const double nu = std::expm1(std::expm1(e * (1 - x)));
  const double l = std::log1p(1 / nu);
  const double d1 = a / (nu * (1 + l));
  return {std::log1p(l) / e, d1, d1 * (-e + e * a * (nu + 1) / nu - e * a / (nu * (1 + l)))};
}

Curve phi(double x) {
  if (x <= 0) return {x, 1, 0};
  const double y = root_of(0, 1, [x](double y) {
    const Curve e = smooth_step_e(y);
    return std::pair{y + e.v - x, 1 + e.d1};
  });
  const Curve e = smooth_step_e(y);
  // E is infinite at 1, where phi is flat.
  if (!std::isfinite(e.d1) || !std::isfinite(e.d2)) return {y, 0, 0};
  const double slope = 1 / (1 + e.d1);
  return {y, slope, -e.d2 * slope * slope * slope};
}

Curve Silhouette::profile(double u, Half half) const {
  if (u <= 0) return {1, 0, 0};
  if (kind == Kind::kSampled) return sampled_profile(samples, u, half);
  // The ray of slope u meets the curve where x = u y(x); there M = 1, so q(u) = 1 / y.
  const double x = root_of(0, 1, [&](double x) {
    const Curve y = upper_half(*this, x);
    return std::pair{x - u * y.v, 1 - u * y.d1};
  });
  const Curve y = upper_half(*this, x);
  // The denominator is 0 only at the fold of a bulge with K = 1, where the profile ends with a vertical tangent.
  const double denominator = std::max(1 - u * y.d1, 1e-6);
  const double x1 = y.v / denominator;
  const double x2 = (2 * y.v * y.d1 + u * y.v * y.d2 * x1) / (denominator * denominator);
  const double v2 = y.v * y.v;
  return {1 / y.v, -y.d1 * x1 / v2, -(y.d2 * x1 * x1 + y.d1 * x2) / v2 + 2 * y.d1 * y.d1 * x1 * x1 / (v2 * y.v)};
}

}  // namespace isofield::operators
