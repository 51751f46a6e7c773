#include "reference/field_state.h"

#include <algorithm>
#include <cmath>

#include "operators/gradient_blend.h"
#include "reference/jet.h"

namespace isofield::reference {
namespace {

using blobtree::dvec3;
using blobtree::NodeKind;

// |steering * length|^2 below which a steering vector counts as (nearly) null.
constexpr double kNullBelow = 1e-3;
// ... and where it does so wholly: its weight would be 3e-74.
constexpr double kNull = 1e-40;

DualVec3 scaled(const DualVec3& v, const Dual& s) {
  return {v.x * s, v.y * s, v.z * s};
}

Dual smoothstep(const Dual& edge, const Dual& x) {
  const Dual t = x * reciprocal(edge);
  if (t.v <= 0) return 0;
  if (t.v >= 1) return 1;
  return t * t * (Dual(3) - Dual(2) * t);
}

FieldState minimum(const FieldState& a, const FieldState& b) {
  return a.field.v <= b.field.v ? a : b;
}

FieldState difference(const FieldState& a, const FieldState& b) {
  const FieldState outside_b{Dual(1) - b.field, scaled(b.steering, -1)};
  const FieldState r = minimum(a, outside_b);
  return r.field.v > 0 ? r : FieldState{};
}

FieldState ricci(double t, const FieldState& a, const FieldState& b) {
  if (a.field.v <= 0) return b;
  if (b.field.v <= 0) return a;
  const double f1 = a.field.v, f2 = b.field.v, big = std::max(f1, f2), small = std::min(f1, f2);
  const double g = big * std::pow(1 + std::pow(small / big, t), 1 / t);
  // g_1 = (f1 / g)^(t - 1) and the like; g_1j follows from d(f1 / g).
  const double g1 = std::pow(f1 / g, t - 1), g2 = std::pow(f2 / g, t - 1);
  const Dual field{g, a.field.d * g1 + b.field.d * g2};
  const auto partial = [&](const Dual& f) {
    const Dual ratio = f * reciprocal(field);
    return chain(ratio, std::pow(ratio.v, t - 1), (t - 1) * std::pow(ratio.v, t - 2));
  };
  return {field, scaled(a.steering, partial(a.field)) + scaled(b.steering, partial(b.field))};
}

// The opening angle with its derivatives: theta(alpha), drawn to theta_min where a steering vector vanishes
// ([G] section 7). Drawn in tan(theta), which is what the operator uses.
Dual opening_angle(const OperatorUse& use, const DualVec3& a, const DualVec3& b) {
  const double least = use.opening->theta_min();
  const Dual square(use.length * use.length);
  const Dual n1 = dot(a, a) * square, n2 = dot(b, b) * square;
  if (std::min(n1.v, n2.v) <= kNull) return least;
  const Dual weight = smoothstep(kNullBelow, n1) * smoothstep(kNullBelow, n2);
  const DualVec3 u = scaled(a, reciprocal(sqrt(dot(a, a)))), v = scaled(b, reciprocal(sqrt(dot(b, b))));
  const DualVec3 normal = cross(u, v);
  const Dual alpha = atan2(sqrt(dot(normal, normal)), dot(u, v));
  const operators::Curve theta = use.opening->theta(alpha.v);
  const double tangent = std::tan(theta.v);
  const Dual least_tangent(std::tan(least));
  const Dual t = least_tangent + (chain(alpha, tangent, (1 + tangent * tangent) * theta.d1) - least_tangent) * weight;
  return chain(t, std::atan(t.v), 1 / (1 + t.v * t.v));
}

FieldState gradient_blend(const OperatorUse& use, const FieldState& a, const FieldState& b) {
  if (a.field.v <= 0) return b;
  if (b.field.v <= 0) return a;
  const Dual theta = opening_angle(use, a.steering, b.steering);
  const operators::Blend g = operators::gradient_blend(a.field.v, b.field.v, theta.v, *use.silhouette);
  const dvec3& f1 = a.field.d;
  const dvec3& f2 = b.field.d;
  const Dual g1{g.g1, f1 * g.g11 + f2 * g.g12 + theta.d * g.g1t};
  const Dual g2{g.g2, f1 * g.g12 + f2 * g.g22 + theta.d * g.g2t};
  return {{g.g, f1 * g.g1 + f2 * g.g2 + theta.d * g.gt}, scaled(a.steering, g1) + scaled(b.steering, g2)};
}

}  // namespace

FieldState evaluate_primitive(const Primitive& primitive, const dvec3& p) {
  const dvec3 q = primitive.to_local.vector(p - primitive.anchor);
  const auto seed = [&](double value, const dvec3& row) {
    Jet j(value);
    j.d = {row.x, row.y, row.z};
    return j;
  };
  const auto& rows = primitive.to_local.linear;
  const blobtree::Vec3<Jet> jets{seed(q.x, rows[0]), seed(q.y, rows[1]), seed(q.z, rows[2])};
  const Jet f = blobtree::soften(blobtree::shape_distance(primitive.shape, jets, primitive.size), primitive.range);
  const auto component = [&](int i) { return Dual(f.d[i], {f.h[i][0], f.h[i][1], f.h[i][2]}); };
  return {{f.v, {f.d[0], f.d[1], f.d[2]}}, {component(0), component(1), component(2)}};
}

FieldState combine(const OperatorUse& use, const FieldState& a, const FieldState& b) {
  switch (use.kind) {
    case NodeKind::kSum:
      return {a.field + b.field, a.steering + b.steering};
    case NodeKind::kMax:
      return a.field.v >= b.field.v ? a : b;
    case NodeKind::kMin:
      return minimum(a, b);
    case NodeKind::kDifference:
      return difference(a, b);
    case NodeKind::kRicci:
      return ricci(use.exponent, a, b);
    case NodeKind::kGradient:
      return gradient_blend(use, a, b);
    case NodeKind::kPrimitive:
    case NodeKind::kTransform:
      break;
  }
  return a;  // not operators
}

}  // namespace isofield::reference
