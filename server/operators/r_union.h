// RUnion is the clean union of R-functions on signed fields, [G] eq. 8: x1 + x2 - sqrt(x1^2 + x2^2).
#pragma once

#include "operators/pasko.h"

namespace isofield::v1 {
class RUnion;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

// It is Pasko's blend (pasko.h) without a displacement, and uses its functions.
struct RUnion {
  static constexpr Traits kTraits{"r_union", Fields::kSigned, Arity::kFolded, true};
  static RUnion read(const v1::RUnion& message, base::FieldReader& in);

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const { Pasko().write(use, tables, out); }

  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    return Pasko().unite(x1, x2);
  }
  Interval bound(const Interval& a, const Interval& b) const { return Pasko().bound(a, b); }
  Spread reached(std::size_t operand) const { return Pasko().reached(operand); }
  Spread kept(std::size_t operand) const { return Pasko().kept(operand); }
  int lone_operand(const Interval&, const Interval&) const { return -1; }
};

}  // namespace isofield::operators
