// Bt2 is the conic blend of two signed fields with individual ranges, [H] eq. 4. It is the root h of
//   H(x_1 - m_1 h, x_2 - m_2 h) = 0,
// so that the zero set does not depend on the weights m_i.
#pragma once

#include <array>

#include "operators/binary.h"
#include "operators/bulge_elimination.h"
#include "operators/kind.h"
#include "operators/terms.h"

namespace isofield::v1 {
class Bt2;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Bt2 {
  static constexpr Traits kTraits{"bt2", Fields::kSigned, Arity::kFolded, true};
  static Bt2 read(const v1::Bt2& message, base::FieldReader& in);

  std::array<Term, 2> terms;
  double conic = 0;  // p of [H] eq. 4
  BulgeElimination elimination;

  OperandCount operand_count() const { return {2, 2}; }
  bool is_ordered() const { return true; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t) const { return 3; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  double weight(std::size_t operand) const { return term(operand).weight; }
  const Term& term(std::size_t operand) const { return terms[operand]; }
  template <class T>
  Reach<T> reach(std::size_t operand) const {
    return {terms[operand].range, terms[operand].weight};
  }
  // Returns 1 - p / (r1 r2), which is positive. It is 1 for the circle or ellipse, and large close to the union.
  double tightness() const { return 1 - conic / (terms[0].range * terms[1].range); }

  template <class T>
  Binary<T> unite(const T& x1, const T& x2) const {
    return blend(x1, x2, reach<T>(0), reach<T>(1), tightness());
  }
  // Returns the same with ranges and weights that follow an angle, if those of the operator do.
  template <class T>
  Binary<T> unite(const T& x1, const T& x2, const Angle<T>& angle) const {
    Reach<T> r1 = reach<T>(0), r2 = reach<T>(1);
    if (elimination.is_on) eliminate_bulge(r1, r2, angle, elimination.omega);
    return blend(x1, x2, r1, r2, tightness());
  }
  Interval bound(const Interval& a, const Interval& b) const;
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;
  // Returns the most that an operand's weight becomes, whatever the gradients.
  double most_weight_of(std::size_t operand) const;
  // Returns the operand, 0 or 1, that alone makes the result, which is then that operand over its weight, or -1 if both
  // may.
  int lone_operand(const Interval& a, const Interval& b) const;

  // Returns the blend in a form without cancellation. With X_i = x_i / m_i and R_i = r_i / m_i it is the blend of
  // weights 1. Instead of p it takes the tightness alone, so that a conic keeps its shape if the ranges follow an
  // angle. The result depends on the place s within ]0, 1[ of X1 - X2 between -R2 and R1; beyond these ends one operand
  // makes it alone. In between, q1 + q2 = 1, off = q1 - q2, and rho is the square root of the quadratic's discriminant,
  // scaled so that it is 1 where the coefficient of h^2 is 0.
  template <class T>
  static Binary<T> blend(const T& x1, const T& x2, const Reach<T>& reach1, const Reach<T>& reach2, double tightness);
};

template <class T>
Binary<T> Bt2::blend(const T& x1, const T& x2, const Reach<T>& reach1, const Reach<T>& reach2, double tightness) {
  using std::sqrt;
  const T i1 = T(1.0) / reach1.weight, i2 = T(1.0) / reach2.weight;
  const T X1 = x1 * i1, X2 = x2 * i2;
  const T R1 = reach1.range * i1, R2 = reach2.range * i2;
  const T per_length = T(1.0) / (R1 + R2);
  const T share1 = R1 * per_length, share2 = R2 * per_length;
  const T apart = (X1 - X2) * per_length;
  const T s1 = share2 + apart, s2 = share1 - apart;  // s and 1 - s
  if (value_of(s1) <= 0) return {X1, i1, T(0.0)};
  if (value_of(s2) <= 0) return {X2, T(0.0), i2};
  const T per_whole = T(1.0) / (share2 * s2 + share1 * s1);
  const T part1 = s1 * per_whole, part2 = s2 * per_whole;
  const T q1 = share2 * part2, q2 = share1 * part1, off = T(0.0) - apart * per_whole;
  const T bend(2 / tightness), product = bend * part1 * part2;
  const T rho = sqrt(off * off + product);
  // These are rho + off and rho - off. The lesser of them follows from their product, without cancellation.
  const T greater = rho + (value_of(off) < 0 ? T(0.0) - off : off), lesser = product / greater;
  const T &above = value_of(off) < 0 ? lesser : greater, &below = value_of(off) < 0 ? greater : lesser;
  const T per_root = T(1.0) / (T(1.0) + rho), scale = per_root / rho;
  // The result lies below either operand, and is the same from both. It is computed from the lesser operand, from which
  // less is taken.
  const T g = value_of(apart) < 0 ? X1 - R1 * s1 * below * per_root : X2 - R2 * s2 * above * per_root;
  return {g, q1 * (bend * part1 + above) * scale * i1, q2 * (bend * part2 + below) * scale * i2};
}

}  // namespace isofield::operators
