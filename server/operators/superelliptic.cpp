#include "operators/superelliptic.h"

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {

Superelliptic Superelliptic::read(const v1::SuperellipticBlend& message, base::FieldReader& in) {
  Superelliptic op;
  op.exponent = in.required_number("exponent", message.exponent(), 1, 64, "an exponent within [1, 64]");
  op.terms = read_terms(message.ranges(), {}, {}, in);
  op.elimination = read_bulge_elimination(message.by_angle(), message.omega(), in);
  return op;
}

Opcode Superelliptic::opcode(Law) const {
  return Opcode::kSuperelliptic;
}

void Superelliptic::write(const Use& use, Tables&, Float4* out) const {
  out[0] = {f32(exponent), elimination.recorded(), 0, 0};
  // The record has the base whose power is 1e12, and the relative error of that base in float32, because the exponent
  // multiplies this error.
  const double deepest = std::pow(1e12, 1 / exponent);
  out[0][2] = f32(deepest);
  out[0][3] = f32(deepest / out[0][2] - 1);
  for (std::uint32_t i = 0; i < use.operands; ++i) out[1 + i] = {1, 0, f32(term(i).power), f32(term(i).range)};
}

Interval Superelliptic::bound_all(const OperandMask& mask, const std::vector<Interval>& x) const {
  const double most = elimination.most_reach();
  double low = 1, high = 1;
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < mask.operands; ++i) {
    if (!mask.has(i)) continue;
    const Interval& v = x[at++];
    const double range = term(i).range;
    low -= bracket(v.lo, v.lo > 0 ? range * most : range * (elimination.is_on ? elimination.omega : 1), exponent).value;
    high -= elimination.is_on && v.hi > 0 ? 0 : bracket(v.hi, range * most, exponent).value;
  }
  return base::padded(low, high);
}

Spread Superelliptic::reached(std::size_t operand) const {
  return {.reach = term(operand).range * elimination.most_reach(), .times = 0, .limit = 1};
}

Spread Superelliptic::kept(std::size_t operand) const {
  return {.times = term(operand).range * elimination.most_reach()};
}

}  // namespace isofield::operators
