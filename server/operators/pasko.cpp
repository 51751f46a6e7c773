#include "operators/pasko.h"

#include <algorithm>
#include <numbers>

#include "base/field_reader.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::operators {
namespace {

// x1 + x2 - sqrt(x1^2 + x2^2) is at least this times the lesser of two positive fields.
constexpr double kLeastSlope = 2 - std::numbers::sqrt2;

double r_union(double x, double y) {
  return x + y - std::hypot(x, y);
}
double farthest(const Interval& i) {
  return std::max(std::abs(i.lo), std::abs(i.hi));
}
double nearest(const Interval& i) {
  return i.lo > 0 ? i.lo : i.hi < 0 ? -i.hi : 0;
}

}  // namespace

Pasko Pasko::read(const v1::PaskoBlend& message, base::FieldReader& in) {
  Pasko p;
  p.a0 = in.coordinate("a0", message.a0());
  p.a1 = in.positive("a1", message.a1());
  p.a2 = in.positive("a2", message.a2());
  return p;
}

Opcode Pasko::opcode(Law) const {
  return Opcode::kPasko;
}

void Pasko::write(const Use&, Tables&, Float4* out) const {
  out[0] = {f32(a0), f32(1 / (a1 * a1)), f32(1 / (a2 * a2)), 0};
}

Interval Pasko::bound(const Interval& a, const Interval& b) const {
  const auto displacement = [&](double x, double y) { return a0 / (1 + x * x / (a1 * a1) + y * y / (a2 * a2)); };
  const double near = displacement(nearest(a), nearest(b)), far = displacement(farthest(a), farthest(b));
  return base::padded(r_union(a.lo, b.lo) + std::min(near, far), r_union(a.hi, b.hi) + std::max(near, far));
}

Spread Pasko::reached(std::size_t) const {
  return {.reach = std::max(-a0, 0.0) / kLeastSlope, .over = kLeastSlope};
}

Spread Pasko::kept(std::size_t) const {
  return {.reach = std::abs(a0)};
}

}  // namespace isofield::operators
