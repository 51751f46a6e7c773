#include "reference/field_state.h"

#include <algorithm>
#include <cmath>

#include "blobtree/primitives/falloff.h"
#include "reference/jet.h"
#include "reference/vec3.h"

namespace isofield::reference {
namespace {

using blobtree::dvec3;
using operators::Form;

// A steering vector counts as nearly null if |steering * length|^2 is below this.
constexpr double kNullBelow = 1e-3;
// It counts as null if the square is below this; its weight would be 3e-74.
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

// Returns the result of an operator of two fields, given its value and its partial derivatives.
FieldState joined(const FieldState& a, const FieldState& b, const operators::Binary<Dual>& o) {
  return {o.g, scaled(a.steering, o.g1) + scaled(b.steering, o.g2)};
}

// Returns a steering vector in the node's frame.
DualVec3 in_frame(const OperatorUse& use, const DualVec3& v) {
  if (!use.frame) return v;
  const blobtree::Affine::LowerTriangle& l = *use.frame;
  return {v.x * Dual(l[0]) + v.y * Dual(l[1]) + v.z * Dual(l[3]), v.y * Dual(l[2]) + v.z * Dual(l[4]),
          v.z * Dual(l[5])};
}

// Makes a signed field constant where it, or its gradient, would leave the range of float32. The device does the same.
FieldState bounded(const FieldState& a) {
  const auto largest = [](const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  constexpr double kMost = operators::kMostField;
  const double slope = std::max(largest(a.field.d), largest({a.steering.x.v, a.steering.y.v, a.steering.z.v}));
  if (std::abs(a.field.v) < kMost && slope < kMost) return a;
  return {std::clamp(a.field.v, -kMost, kMost), {}};
}

// Returns the opening angle with its derivatives. It is theta(alpha), and goes to theta_min where a steering vector
// vanishes ([G] section 7). The interpolation is between tangents, since the operator uses tan(theta).
Dual opening_angle(const OperatorUse& use, const operators::Opening& opening, const DualVec3& a, const DualVec3& b) {
  const double least = opening.theta_min();
  const Dual square(use.length * use.length);
  const Dual n1 = dot(a, a) * square, n2 = dot(b, b) * square;
  if (std::min(n1.v, n2.v) <= kNull) return least;
  const Dual weight = smoothstep(kNullBelow, n1) * smoothstep(kNullBelow, n2);
  const DualVec3 u = scaled(a, reciprocal(sqrt(dot(a, a)))), v = scaled(b, reciprocal(sqrt(dot(b, b))));
  const DualVec3 normal = cross(u, v);
  const Dual alpha = atan2(sqrt(dot(normal, normal)), dot(u, v));
  const operators::Curve theta = opening.theta(alpha.v);
  const double tangent = std::tan(theta.v);
  const Dual least_tangent(std::tan(least));
  const Dual t = least_tangent + (chain(alpha, tangent, (1 + tangent * tangent) * theta.d1) - least_tangent) * weight;
  return chain(t, std::atan(t.v), 1 / (1 + t.v * t.v));
}

// Applies an operator that follows an opening function.
template <class K>
FieldState steer(const K& kind, const OperatorUse& use, const FieldState& a, const FieldState& b) {
  const Dual theta = opening_angle(use, kind.opening, in_frame(use, a.steering), in_frame(use, b.steering));
  const operators::Blend g = kind.blend(a.field.v, b.field.v, theta.v);
  const dvec3& f1 = a.field.d;
  const dvec3& f2 = b.field.d;
  const Dual g1{g.g1, f1 * g.g11 + f2 * g.g12 + theta.d * g.g1t};
  const Dual g2{g.g2, f1 * g.g12 + f2 * g.g22 + theta.d * g.g2t};
  return {{g.g, f1 * g.g1 + f2 * g.g2 + theta.d * g.gt}, scaled(a.steering, g1) + scaled(b.steering, g2)};
}

// Returns the angle between the steering vectors of two signed fields in the form that operators::eliminate_bulge()
// takes: its cosine, which is 0 if one of them vanishes, and the ratio of their lengths.
operators::Angle<Dual> angle_between(const OperatorUse& use, const FieldState& a, const FieldState& b) {
  const DualVec3 u = in_frame(use, a.steering), v = in_frame(use, b.steering);
  const Dual n1 = dot(u, u), n2 = dot(v, v);
  if (std::min(n1.v, n2.v) <= 1e-24) return {0.0, 1.0};
  Dual cosine = dot(u, v) / (sqrt(n1) * sqrt(n2));
  if (std::abs(cosine.v) >= 1) cosine = cosine.v > 0 ? 1.0 : -1.0;
  Dual ratio = sqrt(n1 / n2);
  constexpr double kMost = operators::kMostRatio;
  if (ratio.v < 1 / kMost || ratio.v > kMost) ratio = std::clamp(ratio.v, 1 / kMost, kMost);
  return {cosine, ratio};
}

// Returns the union of two operands. Their order matters.
FieldState unite(const OperatorUse& use, const FieldState& a, const FieldState& b) {
  return use.op->visit([&]<class K>(const K& kind) -> FieldState {
    // A positive field of 0 leaves the other one unchanged. Operators for both laws do this by themselves.
    if constexpr (K::kTraits.fields == operators::Fields::kPositive) {
      if (a.field.v <= 0) return b;
      if (b.field.v <= 0) return a;
    }
    if constexpr (operators::IsSteered<K>) {
      return steer(kind, use, a, b);
    } else if constexpr (operators::IsJoint<K>) {
      return a;  // never reached, since combine() gives these to unite_all()
    } else if constexpr (requires(operators::Angle<Dual> angle) { kind.unite(a.field, b.field, angle); }) {
      return bounded(joined(a, b, kind.unite(a.field, b.field, angle_between(use, a, b))));
    } else {
      const FieldState r = joined(a, b, kind.unite(a.field, b.field));
      return operators::IsSigned<K> ? bounded(r) : r;
    }
  });
}

// Returns the union of all operands at once, for operators that are not folded over pairs.
FieldState unite_all(const OperatorUse& use, const std::vector<FieldState>& x) {
  std::vector<Dual> fields;
  for (const FieldState& s : x) fields.push_back(s.field);
  const operators::Joint<Dual> joint = use.op->visit([&]<class K>(const K& kind) -> operators::Joint<Dual> {
    if constexpr (operators::IsJoint<K>) {
      return kind.unite_all(fields, angle_between(use, x[0], x[1]));
    } else {
      return {};
    }
  });
  FieldState r{joint.g, {}};
  for (std::size_t i = 0; i < x.size(); ++i) r.steering = r.steering + scaled(x[i].steering, joint.partials[i]);
  return bounded(r);
}

// Returns the complement: 1 - f for a positive field, -f for a signed one.
FieldState complement(const OperatorUse& use, const FieldState& a) {
  return {Dual(use.law == operators::Law::kSigned ? 0 : 1) - a.field, scaled(a.steering, -1)};
}

// Replaces a positive field that is negative by 0, as a complement may be.
FieldState clamped(const OperatorUse& use, const FieldState& a) {
  return use.law == operators::Law::kPositive && a.field.v <= 0 ? FieldState{} : a;
}

}  // namespace

FieldState evaluate_primitive(const Primitive& primitive, const dvec3& p) {
  const dvec3 q = primitive.to_local.vector(p - primitive.anchor);
  const auto seed = [&](double value, const dvec3& row) {
    Jet j(value);
    j.d = {row.x, row.y, row.z};
    return j;
  };
  const auto& rows = primitive.to_shape.linear;
  const Vec3<Jet> jets{seed(q.x, rows[0]), seed(q.y, rows[1]), seed(q.z, rows[2])};
  Jet f = std::visit([&](const auto& shape) { return shape.distance(jets); }, primitive.shape);
  if (primitive.law == operators::Law::kPositive) f = blobtree::soften(f, primitive.range);
  const auto component = [&](int i) { return Dual(f.d[i], {f.h[i][0], f.h[i][1], f.h[i][2]}); };
  return {{f.v, {f.d[0], f.d[1], f.d[2]}}, {component(0), component(1), component(2)}};
}

FieldState combine(const OperatorUse& use, const std::vector<FieldState>& operands) {
  const operators::Operator& op = *use.op;
  const Form form = op.form;
  if (op.is_joint()) {
    std::vector<FieldState> x = operands;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (form == Form::kIntersection || (form == Form::kDifference && i == 0)) x[i] = complement(use, x[i]);
    }
    const FieldState r = unite_all(use, x);
    return form == Form::kUnion ? r : complement(use, r);
  }
  FieldState r = operands[0];
  for (std::size_t i = 1; i < operands.size(); ++i) {
    const FieldState& b = operands[i];
    if (form == Form::kUnion) {
      r = unite(use, r, b);
      continue;
    }
    if (use.law == operators::Law::kPositive) {
      const bool is_zero = r.field.v <= 0 || (form == Form::kIntersection && b.field.v <= 0);
      if (is_zero) {
        r = {};
        continue;
      }
      if (op.as<operators::Difference>()) {  // max(0, min(f1, 1 - f2))
        r = clamped(use, minimum(r, complement(use, b)));
        continue;
      }
      if (form == Form::kDifference && b.field.v <= 0 && r.field.v < 1) continue;
      // Neither complement is positive here. The union of the two is then the larger one, so the result is the smaller
      // operand.
      if (form == Form::kIntersection && r.field.v >= 1 && b.field.v >= 1) {
        r = minimum(r, b);
        continue;
      }
    }
    // If one complement is positive and the other is not, the other counts as 0.
    const FieldState first = clamped(use, complement(use, r));
    const FieldState second = form == Form::kIntersection ? clamped(use, complement(use, b)) : b;
    r = clamped(use, complement(use, unite(use, first, second)));
  }
  return r;
}

FieldState placed(const FieldState& child, const blobtree::Affine& inverse) {
  const auto& rows = inverse.linear;
  // Turns a derivative with respect to the child's coordinates q = A^-1 p into one with respect to p.
  const auto by_p = [&](const dvec3& d) { return rows[0] * d.x + rows[1] * d.y + rows[2] * d.z; };
  const auto moved = [&](const Dual& a) { return Dual(a.v, by_p(a.d)); };
  const DualVec3 s{moved(child.steering.x), moved(child.steering.y), moved(child.steering.z)};
  const auto component = [&](double x, double y, double z) { return s.x * Dual(x) + s.y * Dual(y) + s.z * Dual(z); };
  return {moved(child.field),
          {component(rows[0].x, rows[1].x, rows[2].x), component(rows[0].y, rows[1].y, rows[2].y),
           component(rows[0].z, rows[1].z, rows[2].z)}};
}

FieldState soften(const FieldState& a, double range) {
  // These are the first and second derivatives of the falloff of primitives (blobtree/primitives/falloff.h), as a
  // function of the field.
  const double slope = (1 - blobtree::kR0) / range;
  const double r = std::clamp(blobtree::kR0 + slope * a.field.v, 0.0, 1.0), v = 1 - r * r;
  const bool is_inner = r > 0 && r < 1;
  const double w1 = is_inner ? -6 * r * v * v * slope : 0;
  const double w2 = is_inner ? -6 * v * (1 - 5 * r * r) * slope * slope : 0;
  return {chain(a.field, v * v * v, w1), scaled(a.steering, chain(a.field, w1, w2))};
}

FieldState harden(const FieldState& a) {
  return {Dual(0.5) - a.field, scaled(a.steering, -1)};
}

}  // namespace isofield::reference
