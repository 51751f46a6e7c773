// Superelliptic is the super-elliptic blend of signed fields, [G] eq. 4:
//   1 - sum_i [1 - x_i / r_i]_+^t, with [x]_+ = max(0, x).
#pragma once

#include <cmath>
#include <vector>

#include "operators/binary.h"
#include "operators/bulge_elimination.h"
#include "operators/joint.h"
#include "operators/kind.h"
#include "operators/terms.h"

namespace isofield::v1 {
class SuperellipticBlend;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Superelliptic {
  static constexpr Traits kTraits{"superelliptic", Fields::kSigned, Arity::kJoint, true};
  static Superelliptic read(const v1::SuperellipticBlend& message, base::FieldReader& in);

  double exponent = 1;           // t of [G] eq. 4
  std::vector<Term> terms;       // only their ranges count: one for each operand, or one for all
  BulgeElimination elimination;  // Rockwood's ranges, r (1 - cos alpha) + omega r

  OperandCount operand_count() const { return joint_operand_count(terms.size(), elimination); }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t operands) const { return 1 + operands; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  const Term& term(std::size_t operand) const { return term_of(terms, operand); }

  template <class T>
  Joint<T> unite_all(const std::vector<T>& x, const Angle<T>& angle) const {
    Joint<T> r{T(1.0), {}};
    for (std::size_t i = 0; i < x.size(); ++i) {
      const T range =
          elimination.is_on ? angular_range(term(i).range, angle.cosine, elimination.omega) : T(term(i).range);
      const Bracket<T> b = bracket(x[i], range, exponent);
      r.g = r.g - b.value;
      r.partials.push_back(b.fall);
    }
    return r;
  }
  Interval bound_all(const OperandMask& mask, const std::vector<Interval>& x) const;
  // All operands stay active, because beyond all ranges the field is 1, and not that of one operand.
  std::uint32_t active(const OperandMask& mask, const std::vector<Interval>&) const { return mask.bits; }
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;

  // Bracket is one operand's part, [1 - x/r]_+^t, with minus its derivative. Deep inside, where the power is above
  // 1e12, it goes on linearly, because the power would overflow.
  template <class T>
  struct Bracket {
    T value, fall;
  };
  template <class T>
  static Bracket<T> bracket(const T& x, const T& range, double t) {
    using std::pow;
    const T u = T(1.0) - x / range;
    if (value_of(u) <= 0) return {T(0.0), T(0.0)};
    const double deepest = std::pow(1e12, 1 / t);
    if (value_of(u) > deepest) {
      const T slope(t * 1e12 / deepest);
      return {T(1e12) + (u - T(deepest)) * slope, slope / range};
    }
    return {pow(u, t), pow(u, t - 1) * T(t) / range};
  }
};

}  // namespace isofield::operators
