#include "operators/ricci.h"

#include <algorithm>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {
namespace {

double value(double a, double b, double t) {
  const double big = std::max(a, b), small = std::min(a, b);
  return big > 0 ? big * std::pow(1 + std::pow(small / big, t), 1 / t) : 0;
}

}  // namespace

Ricci Ricci::read(const v1::Ricci& message, base::FieldReader& in) {
  return {in.required_number("exponent", message.exponent(), 1, 64, "an exponent within [1, 64]")};
}

Opcode Ricci::opcode(Law) const {
  return Opcode::kRicci;
}

void Ricci::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(exponent), f32(1 / exponent), 0, 0};
}

Interval Ricci::bound(const Interval& a, const Interval& b) const {
  return {value(a.lo, b.lo, exponent), value(a.hi, b.hi, exponent) + base::kValueRoom};
}

}  // namespace isofield::operators
