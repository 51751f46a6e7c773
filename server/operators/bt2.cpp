#include "operators/bt2.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {
namespace {

// These are the limits of 1 - p / (r1 r2) of a conic. It degenerates at p = r1 r2; at p = -1e14 r^2 it is nowhere
// further than 7e-8 r from the union.
constexpr double kLeastTightness = 1e-9, kMostTightness = 1e14;

}  // namespace

Bt2 Bt2::read(const v1::Bt2& m, base::FieldReader& in) {
  const auto weight = [&](const char* name, bool has, double value) {
    return has ? in.number(name, value, 1e-3, 1e3, "a weight within [0.001, 1000]") : 1.0;
  };
  Bt2 op;
  const double r1 = in.positive("r1", m.r1()), r2 = in.positive("r2", m.r2());
  op.terms[0] = {r1, 2, weight("m1", m.has_m1(), m.m1())};
  op.terms[1] = {r2, 2, weight("m2", m.has_m2(), m.m2())};
  op.conic = in.number(
      "p", m.p(), -kMostTightness * r1 * r2, (1 - kLeastTightness) * r1 * r2,
      absl::StrCat("a number below r1 r2 = ", r1 * r2, " by at least ", kLeastTightness, " of it, and at least ",
                   -kMostTightness, " times it: float32 does not tell blends beyond from the union"));
  op.elimination = read_bulge_elimination(m.eliminate_bulge(), m.omega(), in);
  return op;
}

Opcode Bt2::opcode(Law) const {
  return Opcode::kBt2;
}

void Bt2::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(term(0).range), f32(term(1).range), f32(tightness()), elimination.recorded()};
  // The first two numbers of a term's record are those of a kLinear, which takes the blend's place if pruning leaves
  // one operand.
  for (std::uint32_t i = 0; i < 2; ++i) out[1 + i] = {f32(1 / weight(i)), 0, f32(weight(i)), 0};
}

Interval Bt2::bound(const Interval& a, const Interval& b) const {
  const double reach = elimination.most_reach();
  const auto at = [&](double x, double y) { return unite(x, y).g; };
  // Wider ranges add material.
  const double lo = reach == 1 ? at(a.lo, b.lo)
                               : std::min(a.lo / weight(0), b.lo / weight(1)) -
                                     reach * std::max(term(0).range / weight(0), term(1).range / weight(1));
  const double hi = reach == 1 ? at(a.hi, b.hi) : std::min(a.hi / weight(0), b.hi / weight(1));
  return with_grown_weights(elimination, weight(0), weight(1), base::padded(lo, hi));
}

double Bt2::most_weight_of(std::size_t operand) const {
  return elimination.is_on ? most_weight(weight(operand), weight(1 - operand)) : weight(operand);
}

Spread Bt2::reached(std::size_t operand) const {
  return {.reach = term(operand).range * elimination.most_reach(), .times = most_weight_of(operand)};
}

Spread Bt2::kept(std::size_t operand) const {
  return {.times = most_weight_of(operand)};
}

int Bt2::lone_operand(const Interval& a, const Interval& b) const {
  if (elimination.is_on) return -1;
  // These are the bounds of the blending region, [H] section 3.
  const auto is_beyond = [](const Interval& x, const Term& tx, const Interval& y, const Term& ty) {
    const double left = tx.weight * (y.lo - ty.range), right = ty.weight * x.hi;
    return left >= right + base::kValueRoom * (std::abs(right) + std::abs(tx.weight * y.lo) + tx.weight * ty.range);
  };
  return is_beyond(a, terms[0], b, terms[1]) ? 0 : is_beyond(b, terms[1], a, terms[0]) ? 1 : -1;
}

}  // namespace isofield::operators
