// Barthe is Barthe's blend of positive fields, [G] eqs. 12 and 13: its level curves between two lines are elliptical
// arcs.
#pragma once

#include <algorithm>
#include <cmath>

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class BartheBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Barthe {
  static constexpr Traits kTraits{"barthe", Fields::kPositive, Arity::kFolded, true};
  static Barthe read(const v1::BartheBlend& message, base::FieldReader& in);

  // The angles of the two lines from the f1 axis and from the f2 axis, in radians within [0, pi/4].
  double theta1 = 0, theta2 = 0;

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const {
    return by_tangents(f1, f2, std::tan(theta1), std::tan(theta2));
  }
  Interval bound(const Interval& a, const Interval& b) const;

  // The curve of level C lies around C (t2, t1) with semi-axes C (1 - t2) and C (1 - t1), where t = tan(theta). This
  // makes a quadratic in C. It is solved for what C is above the greater field, so that nothing cancels if the lines
  // are close to each other.
  template <class T>
  static Binary<T> by_tangents(const T& f1, const T& f2, double t1, double t2);
};

template <class T>
Binary<T> Barthe::by_tangents(const T& f1, const T& f2, double t1, double t2) {
  using std::sqrt;
  if (value_of(f1) < value_of(f2)) return exchanged(by_tangents(f2, f1, t2, t1));
  if (value_of(f2) <= t1 * value_of(f1)) return {f1, T(1.0), T(0.0)};
  if (value_of(f1) <= t2 * value_of(f2)) return {f2, T(0.0), T(1.0)};
  const double s1 = std::max(1 - t1, 1e-6), s2 = std::max(1 - t2, 1e-6);
  const double tau1 = t1 / s1, tau2 = t2 / s2;
  const T q0 = (f2 - f1 * T(t1)) * T(1 / s1);
  const T b = f1 * T(1 + tau2) + q0 * T(tau1);
  const T above = q0 * q0 / (b + sqrt(b * b - q0 * q0 * T(tau1 * tau1 + tau2 * tau2 - 1)));
  const T c = f1 + above;
  const T p = f1 - above * T(tau2), q = q0 - above * T(tau1);
  const T slope = p * T(tau2) + q * T(tau1) + c;
  return {c, p / slope * T(1 / s2), q / slope * T(1 / s1)};
}

}  // namespace isofield::operators
