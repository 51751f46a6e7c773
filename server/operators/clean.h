// Clean is Barthe's clean union of positive fields, [G] eqs. 9 and 10: sharp on the surface, smooth off it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "operators/binary.h"
#include "operators/kind.h"
#include "operators/root.h"

namespace isofield::v1 {
class CleanUnion;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Clean {
  static constexpr Traits kTraits{"clean", Fields::kPositive, Arity::kFolded, true};
  static Clean read(const v1::CleanUnion& message, base::FieldReader& in);

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use&, Tables&, Float4*) const {}

  // The curve of level C is a quarter of a circle around (k(C), k(C)), of radius C - k(C).
  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const;
  Interval bound(const Interval& a, const Interval& b) const;

  // Returns the centre k(C) of the arc at level C ([G] eq. 10), and k'(C).
  template <class T>
  static std::pair<T, T> centre(const T& c) {
    using std::sqrt;
    if (value_of(c) <= 0.5) return {c * c * T(2.0), c * T(4.0)};
    const T k = sqrt(c * T(0.5));
    return {k, T(0.25) / k};
  }
};

template <class T>
Binary<T> Clean::unite(const T& f1, const T& f2) const {
  using std::sqrt;
  if (value_of(f1) < value_of(f2)) return exchanged(unite(f2, f1));
  const double hi = value_of(f1), lo = value_of(f2);
  // The point lies outside of the arcs, or at the edge, where they have no radius.
  const double own = centre(hi).first;
  if (lo <= own || hi - own <= 1e-12 * hi) return {f1, T(1.0), T(0.0)};
  const double root = root_of(hi, lo < 0.5 ? std::sqrt(lo / 2) : 2 * lo * lo, [&](double c) {
    const auto [k, k_c] = centre(c);
    const double a = hi - k, b = std::max(lo - k, 0.0), m = std::hypot(a, b);
    return std::pair{c - k - m, 1 - k_c * (1 - (a + b) / m)};
  });
  // A Newton step in T from the root gives its derivatives. The slope needs no derivatives of its own for that.
  T c = root;
  T slope = 1.0;
  for (int step = 0; step < 2; ++step) {
    const auto [k, k_c] = centre(c);
    const T a = f1 - k, b = f2 - k;
    const T m = sqrt(a * a + b * b);
    slope = T(1.0) - k_c * (T(1.0) - (a + b) / m);
    if (step == 0) c = c - (c - k - m) * T(1 / value_of(slope));
  }
  const T k = centre(c).first;
  const T denominator = (c - k) * slope;
  return {c, (f1 - k) / denominator, (f2 - k) / denominator};
}

}  // namespace isofield::operators
