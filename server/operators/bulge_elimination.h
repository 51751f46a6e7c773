// Bulge elimination, [H] section 5: ranges and weights of two operands of signed fields that follow the angle between
// their gradients, so that aligned surfaces do not bulge.
#pragma once

#include <algorithm>

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

// What a blend of two operands uses of one of them; numbers, since bulge elimination makes them follow the fields.
template <class T>
struct Reach {
  T range, weight;
};

// Whether ranges follow an angle, and the least part of a range that they keep.
struct BulgeElimination {
  bool is_on = false;
  double omega = 0.01;

  // Ranges that follow an angle lie between omega and so many times the range that is stated.
  double most_reach() const { return is_on ? 2 + omega : 1; }
  // omega as a record has it: negative where ranges follow no angle.
  float recorded() const { return is_on ? f32(omega) : -1.0f; }
};
BulgeElimination read_bulge_elimination(bool is_on, double omega, base::FieldReader& in);

// Gradients' lengths are taken to differ by at most this factor, so that a weight is never more than so many times
// another.
inline constexpr double kMostRatio = 8;

// Weights that follow the gradients grow, to kMostRatio times the other at most, so that fields only shrink towards 0.
inline Interval with_grown_weights(const BulgeElimination& e, double weight1, double weight2, const Interval& i) {
  if (!e.is_on) return i;
  const double shrunk = std::min(weight1, weight2) / (std::max(weight1, weight2) * kMostRatio);
  return {i.lo > 0 ? i.lo * shrunk : i.lo, i.hi < 0 ? i.hi * shrunk : i.hi};
}
// The most that the weight `own` beside `other` becomes where weights follow the gradients.
inline double most_weight(double own, double other) {
  return std::max(own, other * kMostRatio);
}

template <class T>
T angular_range(double range, const T& cosine, double omega) {
  return (T(1 + omega) - cosine) * T(range);
}

// The ratio of the angle is 1 of distances; it is kept within [1 / kMostRatio, kMostRatio].
template <class T>
void eliminate_bulge(Reach<T>& reach1, Reach<T>& reach2, const Angle<T>& angle, double omega) {
  reach1.range = angular_range(value_of(reach1.range), angle.cosine, omega);
  reach2.range = angular_range(value_of(reach2.range), angle.cosine, omega);
  if (value_of(angle.cosine) <= 0) return;
  const T m1 = reach1.weight, m2 = reach2.weight;
  if (value_of(m1) > value_of(m2) * value_of(angle.ratio)) {
    reach2.weight = m2 + (m1 / angle.ratio - m2) * angle.cosine;
  } else {
    reach1.weight = m1 + (m2 * angle.ratio - m1) * angle.cosine;
  }
}

}  // namespace isofield::operators
