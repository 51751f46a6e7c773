#include "operators/bernhardt.h"

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"

namespace isofield::operators {

Bernhardt Bernhardt::read(const v1::BernhardtBlend& message, base::FieldReader& in) {
  Bernhardt b;
  b.barthe.theta1 = read_tangent_angle("theta1", message.theta1(), in);
  b.barthe.theta2 = read_tangent_angle("theta2", message.theta2(), in);
  b.weight = in.number("weight", message.weight(), 0, 1, "a weight within [0, 1]");
  return b;
}

Opcode Bernhardt::opcode(Law) const {
  return Opcode::kBernhardt;
}

void Bernhardt::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(std::tan(barthe.theta1)), f32(std::tan(barthe.theta2)), f32(weight), 0};
}

Interval Bernhardt::bound(const Interval& a, const Interval& b) const {
  // Level curves are arcs, at most a quarter of a circle around the origin.
  return {std::max(a.lo, b.lo), std::hypot(a.hi, b.hi) + base::kValueRoom};
}

}  // namespace isofield::operators
