// Bulge elimination, [H] section 5, lets the ranges and weights of two operands of signed fields follow the angle
// between their gradients, so that aligned surfaces do not bulge.
#pragma once

#include <algorithm>

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

// Reach is what a blend of two operands uses of one of them. Its members are numbers of the type T, because bulge
// elimination makes them follow the fields.
template <class T>
struct Reach {
  T range, weight;
};

// BulgeElimination says whether ranges follow an angle, and which part of a range they keep at least (omega).
struct BulgeElimination {
  bool is_on = false;
  double omega = 0.01;

  // Ranges that follow an angle lie between omega times and most_reach() times the range that is stated.
  double most_reach() const { return is_on ? 2 + omega : 1; }
  // Returns omega as a record has it, which is negative if ranges follow no angle.
  float recorded() const { return is_on ? f32(omega) : -1.0f; }
};
BulgeElimination read_bulge_elimination(bool is_on, double omega, base::FieldReader& in);

// The lengths of two gradients are taken to differ by at most this factor, so that a weight becomes at most this many
// times the other one.
inline constexpr double kMostRatio = 8;

// Returns bounds that also hold if the weights follow the gradients. Such weights only grow, to kMostRatio times the
// other one at most, so that fields only shrink towards 0.
inline Interval with_grown_weights(const BulgeElimination& e, double weight1, double weight2, const Interval& i) {
  if (!e.is_on) return i;
  const double shrunk = std::min(weight1, weight2) / (std::max(weight1, weight2) * kMostRatio);
  return {i.lo > 0 ? i.lo * shrunk : i.lo, i.hi < 0 ? i.hi * shrunk : i.hi};
}
// Returns the most that the weight `own` beside `other` becomes if weights follow the gradients.
inline double most_weight(double own, double other) {
  return std::max(own, other * kMostRatio);
}

template <class T>
T angular_range(double range, const T& cosine, double omega) {
  return (T(1 + omega) - cosine) * T(range);
}

// Makes the ranges and weights follow an angle. The caller keeps angle.ratio within [1 / kMostRatio, kMostRatio]; it is
// 1 for distances.
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
