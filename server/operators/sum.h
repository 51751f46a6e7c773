// Sum is the operator that adds positive fields, [G] eq. 3.
#pragma once

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class Sum;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Sum {
  static constexpr Traits kTraits{"sum", Fields::kPositive, Arity::kFolded, false};
  static Sum read(const v1::Sum& message, base::FieldReader& in);

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return false; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use&, Tables&, Float4*) const {}

  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const {
    return {f1 + f2, T(1.0), T(1.0)};
  }
  Interval bound(const Interval& a, const Interval& b) const { return {a.lo + b.lo, a.hi + b.hi}; }
};

}  // namespace isofield::operators
