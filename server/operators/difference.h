// Difference is the operator that takes the other fields away from the first one: max(0, min(f1, 1 - f2)) for positive
// fields, and max(f1, -f2) for signed ones.
#pragma once

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class Difference;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Difference {
  static constexpr Traits kTraits{"difference", Fields::kEither, Arity::kFolded, false};
  static Difference read(const v1::Difference& message, base::FieldReader& in);

  OperandCount operand_count() const { return {2, kAnyNumber}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  // max(x1, -x2) = -min(-x1, x2) for signed fields: their union is the minimum.
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use&, Tables&, Float4*) const {}

  // Returns the union of signed fields. Their difference is made of it as that of any other kind.
  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    return value_of(x1) <= value_of(x2) ? Binary<T>{x1, T(1.0), T(0.0)} : Binary<T>{x2, T(0.0), T(1.0)};
  }
  Interval bound(const Interval& a, const Interval& b) const;
  // Returns the interval of max(0, min(f1, 1 - f2)) of positive fields.
  static Interval bound_positive(const Interval& a, const Interval& b);
};

}  // namespace isofield::operators
