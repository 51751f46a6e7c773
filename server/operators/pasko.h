// Pasko is Pasko's blend of signed fields, [G] eq. 5: the union of R-functions (r_union.h) with a displacement added.
#pragma once

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class PaskoBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Pasko {
  static constexpr Traits kTraits{"pasko", Fields::kSigned, Arity::kFolded, true};
  static Pasko read(const v1::PaskoBlend& message, base::FieldReader& in);

  double a0 = 0;          // the displacement where both fields are 0; negative adds material
  double a1 = 1, a2 = 1;  // how far along each field it reaches

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  // The union of R-functions has no gradient where both fields are 0. The partials are 1 and 1 there.
  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    using std::sqrt;
    const T r = sqrt(x1 * x1 + x2 * x2);
    const T inverse = value_of(r) > 0 ? T(1.0) / r : T(0.0);
    const T w = T(1.0) / (T(1.0) + x1 * x1 * T(1 / (a1 * a1)) + x2 * x2 * T(1 / (a2 * a2)));
    const T fall = w * w * T(2 * a0);
    return {x1 + x2 - r + w * T(a0), T(1.0) - x1 * inverse - fall * x1 * T(1 / (a1 * a1)),
            T(1.0) - x2 * inverse - fall * x2 * T(1 / (a2 * a2))};
  }
  Interval bound(const Interval& a, const Interval& b) const;
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;
  int lone_operand(const Interval&, const Interval&) const { return -1; }
};

}  // namespace isofield::operators
