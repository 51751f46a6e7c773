// Ricci is Ricci's blend of positive fields, [G] eq. 11: (f1^t + f2^t)^(1/t).
#pragma once

#include <cmath>

#include "operators/binary.h"
#include "operators/kind.h"

namespace isofield::v1 {
class Ricci;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Ricci {
  static constexpr Traits kTraits{"ricci", Fields::kPositive, Arity::kFolded, false};
  static Ricci read(const v1::Ricci& message, base::FieldReader& in);

  double exponent = 1;  // t, at least 1

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  // The larger field is factored out, so that no power underflows or overflows.
  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const {
    using std::pow;
    if (value_of(f2) <= 0) return {f1, T(1.0), T(0.0)};
    if (value_of(f1) <= 0) return {f2, T(0.0), T(1.0)};
    if (value_of(f1) < value_of(f2)) return exchanged(unite(f2, f1));
    const T g = f1 * pow(pow(f2 / f1, exponent) + T(1.0), 1 / exponent);
    return {g, pow(f1 / g, exponent - 1), pow(f2 / g, exponent - 1)};
  }
  Interval bound(const Interval& a, const Interval& b) const;
};

}  // namespace isofield::operators
