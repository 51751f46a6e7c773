#include "operators/smooth_min.h"

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {

SmoothMin SmoothMin::read(const v1::SmoothMin& message, base::FieldReader& in) {
  return {in.positive("radius", message.radius())};
}

Opcode SmoothMin::opcode(Law) const {
  return Opcode::kSmoothMin;
}

void SmoothMin::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(radius), f32(1 / radius), 0, 0};
}

Interval SmoothMin::bound(const Interval& a, const Interval& b) const {
  // The blend increases with either field. If the result is near 0, the term that is subtracted has a larger rounding
  // error than the size of the result tells.
  const double room = base::kValueRoom * radius / 4;
  const Interval r = base::padded(unite(a.lo, b.lo).g, unite(a.hi, b.hi).g);
  return {r.lo - room, r.hi + room};
}

Spread SmoothMin::reached(std::size_t) const {
  return {.reach = radius / 4};
}

Spread SmoothMin::kept(std::size_t) const {
  return {};
}

int SmoothMin::lone_operand(const Interval& a, const Interval& b) const {
  const auto is_less = [&](const Interval& x, const Interval& y) {
    return y.lo - x.hi >= radius + base::kValueRoom * (std::abs(x.hi) + std::abs(y.lo) + radius);
  };
  return is_less(a, b) ? 0 : is_less(b, a) ? 1 : -1;
}

}  // namespace isofield::operators
