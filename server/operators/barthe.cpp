#include "operators/barthe.h"

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"

namespace isofield::operators {

Barthe Barthe::read(const v1::BartheBlend& message, base::FieldReader& in) {
  const double theta1 = read_tangent_angle("theta1", message.theta1(), in);
  return {theta1, read_tangent_angle("theta2", message.theta2(), in)};
}

Opcode Barthe::opcode(Law) const {
  return Opcode::kBarthe;
}

void Barthe::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(std::tan(theta1)), f32(std::tan(theta2)), 0, 0};
}

Interval Barthe::bound(const Interval& a, const Interval& b) const {
  // Level curves are arcs, at most a quarter of a circle around the origin.
  return {std::max(a.lo, b.lo), std::hypot(a.hi, b.hi) + base::kValueRoom};
}

}  // namespace isofield::operators
