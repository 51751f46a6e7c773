// The operators of `signed` fields (negative inside) in [G] section 2: eqs. 4 to 6 and 8.
#pragma once

#include "operators/binary.h"
#include "operators/sampled_curve.h"

namespace isofield::operators {

// Signed fields of nested and folded operators end here, where float32 nearly does, and are constant beyond.
inline constexpr double kMostField = 1e37;

// [G] eq. 5: the R-function union (eq. 8) with a0 / (1 + (x1/a1)^2 + (x2/a2)^2) added. Where both fields are 0 the
// union has no gradient; 1, 1 is returned.
template <class T>
Binary<T> pasko_blend(const T& x1, const T& x2, double a0, double a1, double a2) {
  using std::sqrt;
  const T r = sqrt(x1 * x1 + x2 * x2);
  const T inverse = value_of(r) > 0 ? T(1.0) / r : T(0.0);
  const T w = T(1.0) / (T(1.0) + x1 * x1 * T(1 / (a1 * a1)) + x2 * x2 * T(1 / (a2 * a2)));
  const T fall = w * w * T(2 * a0);
  return {x1 + x2 - r + w * T(a0), T(1.0) - x1 * inverse - fall * x1 * T(1 / (a1 * a1)),
          T(1.0) - x2 * inverse - fall * x2 * T(1 / (a2 * a2))};
}

// One operand's part of the super-elliptic blend, [G] eq. 4: [1 - x/r]_+^t, with minus its derivative. Deep inside,
// where the power is above 1e12, it goes on straight: a power would leave the numbers.
template <class T>
struct Bracket {
  T value, fall;
};
template <class T>
Bracket<T> superelliptic_bracket(const T& x, const T& range, double t) {
  using std::pow;
  const T u = T(1.0) - x / range;
  if (value_of(u) <= 0) return {T(0.0), T(0.0)};
  const double deepest = std::pow(1e12, 1 / t);
  if (value_of(u) > deepest) {
    const T slope(t * 1e12 / deepest);
    return {T(1e12) + (u - T(deepest)) * slope, slope / range};
  }
  return {pow(u, t), pow(u, t - 1) * T(t) / range};
}

// A function with this value and slope at x.
inline double chain(double, double value, double) {
  return value;
}

// [G] eq. 6: min(x1, x2) - H(|x1 - x2|). Where the fields are equal the partials are those of the side x1 < x2.
template <class T>
Binary<T> functional_blend(const T& x1, const T& x2, const SampledCurve& profile) {
  if (value_of(x2) < value_of(x1)) return exchanged(functional_blend(x2, x1, profile));
  const T apart = x2 - x1;
  const Curve h = profile.at(value_of(apart));
  const T slope = chain(apart, h.d1, h.d2);
  return {x1 - chain(apart, h.v, h.d1), T(1.0) + slope, T(0.0) - slope};
}

}  // namespace isofield::operators
