// Functional is Barthe's functional blend of signed fields, [G] eq. 6: min(x1, x2) - H(|x1 - x2|).
#pragma once

#include "operators/binary.h"
#include "operators/kind.h"
#include "operators/sampled_curve.h"

namespace isofield::v1 {
class FunctionalBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

// chain() applies the chain rule. It takes a number, a function's value there and its slope; for a number without
// derivatives it returns the value. Numbers that carry derivatives have a chain() of their own.
inline double chain(double, double value, double) {
  return value;
}

struct Functional {
  static constexpr Traits kTraits{"functional", Fields::kSigned, Arity::kFolded, true};
  static Functional read(const v1::FunctionalBlend& message, base::FieldReader& in);

  SampledCurve h;  // H(x) for x >= 0

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  // If the fields are equal, the partials are those of the side x1 < x2.
  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    if (value_of(x2) < value_of(x1)) return exchanged(unite(x2, x1));
    const T apart = x2 - x1;
    const Curve at = h.at(value_of(apart));
    const T slope = chain(apart, at.d1, at.d2);
    return {x1 - chain(apart, at.v, at.d1), T(1.0) + slope, T(0.0) - slope};
  }
  Interval bound(const Interval& a, const Interval& b) const;
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;
  // Returns the operand, 0 or 1, that is the lesser by more than H reaches, and so is the result, or -1 if there is
  // none.
  int lone_operand(const Interval& a, const Interval& b) const;
};

}  // namespace isofield::operators
