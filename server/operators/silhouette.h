// Silhouette describes a silhouette of the gradient-based blend by its profile q(u): with a >= b >= 0 and u = b / a,
// M(a, b) = a q(u) is the smooth maximum, homogeneous of degree 1, whose unit level curve is the silhouette s of [G]
// eqs. 21 to 24.
#pragma once

#include <compare>

#include "operators/derivatives.h"
#include "operators/sampled_curve.h"

namespace isofield::operators {

struct Silhouette {
  enum class Kind { kSmooth, kBulge, kSampled };
  Kind kind = Kind::kSmooth;
  double k = 0;            // kBulge: within [0, 1]
  SampledCurve samples{};  // kSampled: s(phi) over [0, pi/2] from the f1 axis

  // Half says which half of the curve a profile is of: the one with f1 >= f2, or the one with f2 > f1. Only sampled
  // curves have two different halves.
  enum class Half { kFirst, kSecond };
  bool is_symmetric() const { return kind != Kind::kSampled; }
  // Returns q, q', q'' at u within [0, 1]. q(0) = 1 and q'(0) = 0 exactly.
  Curve profile(double u, Half half = Half::kFirst) const;
  auto operator<=>(const Silhouette&) const = default;
};

// Returns E(x) for x within [0, 1[, with derivatives. The curve (x, 1 - E(x)) is the smooth silhouette ([G] eq. 30),
// and x + E(x) is the inverse of phi ([G] eq. 20).
Curve smooth_step_e(double x);

// Returns phi(x) for x within [0, 2], with derivatives. It is the inverse of x + E(x).
Curve phi(double x);

}  // namespace isofield::operators
