// Max is the operator that takes the greatest of fields of either law: the union of positive fields ([G] eq. 7), and
// the intersection of signed ones.
#pragma once

#include <algorithm>

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class Max;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Max {
  static constexpr Traits kTraits{"max", Fields::kEither, Arity::kFolded, false};
  static Max read(const v1::Max& message, base::FieldReader& in);

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use&, Tables&, Float4*) const {}

  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const {
    return value_of(f1) >= value_of(f2) ? Binary<T>{f1, T(1.0), T(0.0)} : Binary<T>{f2, T(0.0), T(1.0)};
  }
  Interval bound(const Interval& a, const Interval& b) const { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }
};

}  // namespace isofield::operators
