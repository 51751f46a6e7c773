// Bernhardt is Bernhardt's operator on positive fields: an interpolation between the clean union and Barthe's blend
// ([G] section 2).
#pragma once

#include "operators/barthe.h"
#include "operators/clean.h"

namespace isofield::v1 {
class BernhardtBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Bernhardt {
  static constexpr Traits kTraits{"bernhardt", Fields::kPositive, Arity::kFolded, true};
  static Bernhardt read(const v1::BernhardtBlend& message, base::FieldReader& in);

  Barthe barthe;
  double weight = 1;  // within [0, 1]: 0 is the clean union, 1 Barthe's blend

  OperandCount operand_count() const { return {1, kAnyNumber}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 1; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  template <class T>
  Binary<T> unite(const T& f1, const T& f2) const {
    const Binary<T> u = Clean().unite(f1, f2), b = barthe.unite(f1, f2);
    const T v(1 - weight), w(weight);
    return {u.g * v + b.g * w, u.g1 * v + b.g1 * w, u.g2 * v + b.g2 * w};
  }
  Interval bound(const Interval& a, const Interval& b) const;
};

}  // namespace isofield::operators
