// Silhouettes of the gradient-based blend as profiles q(u): with a >= b >= 0 and u = b / a, M(a, b) = a q(u) is the
// smooth maximum, homogeneous of degree 1, whose unit level curve is the silhouette s of [G] eqs. 21 to 24.
#pragma once

#include <compare>

#include "operators/derivatives.h"

namespace isofield::operators {

struct Silhouette {
  enum class Kind { kSmooth, kBulge };
  Kind kind = Kind::kSmooth;
  double k = 0;  // kBulge: within [0, 1]

  // q, q', q'' at u within [0, 1]. q(0) = 1 and q'(0) = 0 exactly.
  Curve profile(double u) const;
  auto operator<=>(const Silhouette&) const = default;
};

// E(x) for x within [0, 1[, with derivatives: the curve (x, 1 - E(x)) is the smooth silhouette ([G] eq. 30), and
// x + E(x) is the inverse of phi ([G] eq. 20).
Curve smooth_step_e(double x);

// phi(x) for x within [0, 2], with derivatives: the inverse of x + E(x).
Curve phi(double x);

}  // namespace isofield::operators
