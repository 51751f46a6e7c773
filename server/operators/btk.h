// Btk is the super-elliptic blend of signed fields with individual ranges, [H] eq. 5. It is the root h of
//   sum_i [(r_i - x_i + m_i h) / r_i]_+^p_i = 1.
#pragma once

#include <cmath>
#include <vector>

#include "operators/binary.h"
#include "operators/bulge_elimination.h"
#include "operators/joint.h"
#include "operators/kind.h"
#include "operators/terms.h"

namespace isofield::v1 {
class Btk;
}
namespace isofield::base {
class FieldReader;
}

namespace isofield::operators {

struct Btk {
  static constexpr Traits kTraits{"btk", Fields::kSigned, Arity::kJoint, true};
  static Btk read(const v1::Btk& message, base::FieldReader& in);

  std::vector<Term> terms;  // one for each operand, or one for all
  BulgeElimination elimination;

  OperandCount operand_count() const { return joint_operand_count(terms.size(), elimination); }
  bool is_ordered() const { return false; }
  bool may_crease() const { return true; }
  Opcode opcode(Law law) const;
  std::uint32_t record_size(std::uint32_t operands) const { return 1 + operands; }
  void write(const Use& use, Tables& tables, Float4* out) const;

  double weight(std::size_t operand) const { return term(operand).weight; }
  const Term& term(std::size_t operand) const { return term_of(terms, operand); }

  template <class T>
  Joint<T> unite_all(const std::vector<T>& x, const Angle<T>& angle) const {
    std::vector<Reach<T>> reach;
    std::vector<double> powers;
    for (std::size_t i = 0; i < x.size(); ++i) {
      reach.push_back({term(i).range, term(i).weight});
      powers.push_back(term(i).power);
    }
    if (elimination.is_on) eliminate_bulge(reach[0], reach[1], angle, elimination.omega);
    return root(x, reach, powers);
  }
  Interval bound_all(const OperandMask& mask, const std::vector<Interval>& x) const;
  // Returns the operands that can make a difference. An operand drops out if it is beyond its range even at the largest
  // value that the result can have.
  std::uint32_t active(const OperandMask& mask, const std::vector<Interval>& x) const;
  Spread reached(std::size_t operand) const;
  Spread kept(std::size_t operand) const;
  // Returns the most that an operand's weight becomes, whatever the gradients.
  double most_weight_of(std::size_t operand) const;

  // Finds the root h; the powers p_i must be above 1. The sum is convex and increasing in h and at least 1 at min x_i /
  // m_i, so Newton's method from there falls to the root and never beyond it: no bracket is needed (the paper uses
  // Regula Falsi).
  template <class T>
  static Joint<T> root(const std::vector<T>& x, const std::vector<Reach<T>>& reach, const std::vector<double>& powers);
};

template <class T>
Joint<T> Btk::root(const std::vector<T>& x, const std::vector<Reach<T>>& reach, const std::vector<double>& powers) {
  using std::pow;
  const std::size_t k = x.size();
  std::size_t least = 0;
  for (std::size_t i = 1; i < k; ++i) {
    if (value_of(x[i]) / value_of(reach[i].weight) < value_of(x[least]) / value_of(reach[least].weight)) least = i;
  }
  double h = value_of(x[least]) / value_of(reach[least].weight);
  const auto bracket = [&](std::size_t i, double h) {
    return (value_of(reach[i].range) - value_of(x[i]) + value_of(reach[i].weight) * h) / value_of(reach[i].range);
  };
  bool is_blend = false;
  for (std::size_t i = 0; i < k; ++i) is_blend |= i != least && bracket(i, h) > 0;
  const T inverse = T(1.0) / reach[least].weight;
  Joint<T> r{x[least] * inverse, std::vector<T>(k, T(0.0))};
  if (!is_blend) {
    r.partials[least] = inverse;
    return r;
  }
  double slope = 0;
  for (int step = 0; step < 60; ++step) {
    double excess = -1;
    slope = 0;
    for (std::size_t i = 0; i < k; ++i) {
      const double t = bracket(i, h);
      if (t <= 0) continue;
      excess += std::pow(t, powers[i]);
      slope += powers[i] * std::pow(t, powers[i] - 1) * value_of(reach[i].weight) / value_of(reach[i].range);
    }
    const double next = h - excess / slope;
    if (!(next < h)) break;
    h = next;
  }
  // A Newton step in T gives the root's derivatives. A second pass gives the partials with theirs.
  r.g = T(h);
  for (int pass = 0; pass < 2; ++pass) {
    T excess(-1.0), total(0.0);
    for (std::size_t i = 0; i < k; ++i) {
      const T t = (reach[i].range - x[i] + reach[i].weight * r.g) / reach[i].range;
      if (value_of(t) <= 0) {
        r.partials[i] = T(0.0);
        continue;
      }
      excess = excess + pow(t, powers[i]);
      r.partials[i] = pow(t, powers[i] - 1) * T(powers[i]) / reach[i].range;
      total = total + r.partials[i] * reach[i].weight;
    }
    if (pass == 0) {
      r.g = r.g - excess * T(1 / slope);
    } else {
      for (T& partial : r.partials) partial = partial / total;
    }
  }
  return r;
}

}  // namespace isofield::operators
