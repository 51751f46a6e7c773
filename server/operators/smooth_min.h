// SmoothMin is the quadratic smooth minimum of signed fields, with one radius:
//   min(x1, x2) - radius / 4 h^2,  h = max(0, 1 - |x1 - x2| / radius)
// (I. Quilez, "Smooth minimum"). As an intersection it is the smooth maximum, its dual.
#pragma once

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class SmoothMin;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct SmoothMin {
  static constexpr Traits kTraits{"smooth_min", Fields::kSigned, Arity::kFolded, true};
  static SmoothMin read(const v1::SmoothMin& message, base::FieldReader& in);

  double radius = 1;  // fields that differ by this and more are not blended

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    if (value_of(x2) < value_of(x1)) return exchanged(unite(x2, x1));
    const T h = T(1.0) - (x2 - x1) * T(1 / radius);
    if (value_of(h) <= 0) return {x1, T(1.0), T(0.0)};
    return {x1 - h * h * T(radius / 4), T(1.0) - h * T(0.5), h * T(0.5)};
  }
  Interval bound(const Interval& a, const Interval& b) const;
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;
  // Returns the operand, 0 or 1, that is the lesser by at least the radius, and so is the result, or -1 if there is
  // none.
  int lone_operand(const Interval& a, const Interval& b) const;
};

}  // namespace isofield::operators
