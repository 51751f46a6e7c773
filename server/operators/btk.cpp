#include "operators/btk.h"

#include <algorithm>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {

Btk Btk::read(const v1::Btk& message, base::FieldReader& in) {
  Btk op;
  op.terms = read_terms(message.ranges(), message.powers(), message.weights(), in);
  op.elimination = read_bulge_elimination(message.eliminate_bulge(), message.omega(), in);
  return op;
}

Opcode Btk::opcode(Law) const {
  return Opcode::kBtk;
}

void Btk::write(const Use& use, Tables&, Float4* out) const {
  // The first number is the exponent of a super-elliptic blend; here each operand has its own.
  out[0] = {1, elimination.recorded(), 0, 0};
  for (std::uint32_t i = 0; i < use.operands; ++i) {
    out[1 + i] = {f32(1 / weight(i)), 0, f32(term(i).power), f32(term(i).range)};
  }
}

Interval Btk::bound_all(const OperandMask& mask, const std::vector<Interval>& x) const {
  std::vector<double> lows, highs, powers;
  std::vector<Reach<double>> reach;
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < mask.operands; ++i) {
    if (!mask.has(i)) continue;
    lows.push_back(x[at].lo);
    highs.push_back(x[at++].hi);
    powers.push_back(term(i).power);
    reach.push_back({term(i).range, term(i).weight});
  }
  if (!elimination.is_on) return base::padded(root(lows, reach, powers).g, root(highs, reach, powers).g);
  Interval r;
  double least = lows[0] / reach[0].weight, widest = 0;
  for (std::size_t i = 0; i < lows.size(); ++i) {
    least = std::min(least, lows[i] / reach[i].weight);
    widest = std::max(widest, reach[i].range * elimination.most_reach() / reach[i].weight);
    r.hi = i == 0 ? highs[i] / reach[i].weight : std::min(r.hi, highs[i] / reach[i].weight);
  }
  r.lo = least - widest;
  r = with_grown_weights(elimination, weight(0), weight(1), r);
  return base::padded(r.lo, r.hi);
}

std::uint32_t Btk::active(const OperandMask& mask, const std::vector<Interval>& x) const {
  if (elimination.is_on) return mask.bits;
  double least = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < mask.operands; ++i) {
    if (mask.has(i)) least = std::min(least, x[at++].hi / weight(i));
  }
  std::uint32_t active = 0;
  at = 0;
  for (std::uint32_t i = 0; i < mask.operands; ++i) {
    if (!mask.has(i)) continue;
    const Term& t = term(i);
    const double low = x[at++].lo, needed = t.range + t.weight * least;
    if (low < needed + base::kValueRoom * (std::abs(low) + std::abs(t.weight * least) + t.range)) active |= 1u << i;
  }
  return active;
}

double Btk::most_weight_of(std::size_t operand) const {
  return elimination.is_on ? most_weight(weight(operand), weight(1 - operand)) : weight(operand);
}

Spread Btk::reached(std::size_t operand) const {
  return {.reach = term(operand).range * elimination.most_reach(), .times = most_weight_of(operand)};
}

Spread Btk::kept(std::size_t operand) const {
  return {.times = most_weight_of(operand)};
}

}  // namespace isofield::operators
