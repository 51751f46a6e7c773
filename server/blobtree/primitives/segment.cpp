#include "blobtree/primitives/segment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {
namespace {

// The direction of a vector is not reliable if it is shorter than this times the radius of the box.
constexpr double kLeastOffset = 1e-6;

// A rigidly placed round cone is the union of a family of spheres. NearestSphere is the one with the least distance
// from p, which is the cone's distance. `offset` leads from its centre to p, in the world.
struct NearestSphere {
  dvec3 offset;
  double radius;
};
NearestSphere nearest_sphere(const Segment& s, const Domain& domain, const dvec3& p) {
  const dvec3 v = p - domain.anchor;
  const dvec3& axis = domain.to_local.linear[2];
  if (s.is_sphere()) return {s.sphere_centre() == 0 ? v : v - axis * s.length, s.largest_radius()};
  const double sin_tilt = (s.radius_a - s.radius_b) / s.length;
  const double tan_tilt = sin_tilt / std::sqrt(1 - sin_tilt * sin_tilt);
  const double y = dot(axis, v);
  const double c = std::clamp(y - length(v - axis * y) * tan_tilt, 0.0, s.length);
  return {v - axis * c, s.radius_a - c * sin_tilt};
}

// RoundCone holds a round cone as records do, with the slope of its radius and the tangent of its tilt. If one end
// contains the other, it is a sphere.
struct RoundCone {
  double centre, length, radius, slope, tan;
};
RoundCone cone_of(const Segment& s) {
  if (s.is_sphere()) return {s.sphere_centre(), 0, s.largest_radius(), 0, 0};
  const double sin = (s.radius_a - s.radius_b) / s.length;
  return {0, s.length, s.radius_a, -sin, sin / std::sqrt(1 - sin * sin)};
}

}  // namespace

Segment Segment::read(const v1::Segment& message, FieldReader& in, Affine& frame) {
  const dvec3 a = in.stated_point("a", message.a()), b = in.stated_point("b", message.b());
  const dvec3 axis = b - a;
  Segment s;
  s.length = glm::length(axis);
  s.radius_a = in.positive("radius_a", message.radius_a());
  s.radius_b = in.positive("radius_b", message.radius_b());
  frame = s.length > 0 ? Affine::frame(a, axis) : Affine::translation(a);
  return s;
}

Segment Segment::scaled(double factor) const {
  return {length * factor, radius_a * factor, radius_b * factor};
}
double Segment::largest() const {
  return std::max({length, radius_a, radius_b});
}
double Segment::own_lengths() const {
  return length + radius_a;
}
double Segment::least_radius() const {
  return is_sphere() ? largest_radius() : std::min(radius_a, radius_b);
}
double Segment::area() const {
  const double radius = largest_radius();
  return 2 * std::numbers::pi * radius * length + 4 * std::numbers::pi * radius * radius;
}
double Segment::growth() const {
  return 1;
}

blobtree::Box Segment::support(const Affine& to_world, double range) const {
  // The box around two balls is far tighter than the box of a tilted box.
  const auto ball = [&](const dvec3& centre, double r) {
    Affine at = to_world;
    at.offset = centre;
    return ellipsoid_image(at, {r, r, r});
  };
  blobtree::Box box = ball(to_world.offset, radius_a + range);
  box.add(ball(to_world.point({0, 0, length}), radius_b + range));
  return box;
}

Operand Segment::operand(bool is_rigid) const {
  return is_rigid ? Operand::kSegment : Operand::kAffineSegment;
}

void Segment::write(const Domain& domain, Slope slope, Operand operand, Float4* out) const {
  const RoundCone c = cone_of(*this);
  const dvec3& axis = domain.to_local.linear[2];
  dvec3 a = domain.anchor;
  if (operand == Operand::kAffineSegment) {
    write_rows(domain, slope, c.length, c.radius, c.slope, out);
    // If one end contains the other, the record has the centre of that end, which lies on the axis.
    if (c.centre != 0) a = a + domain.to_local.inverse()->vector({0, 0, c.centre});
  } else {
    a = a + axis * c.centre;
    out[1] = {f32(axis.x), f32(axis.y), f32(axis.z), f32(c.length)};
    out[2] = {f32(c.radius), f32(c.slope), f32(c.tan), 0};
  }
  out[0] = {f32(a.x), f32(a.y), f32(a.z), slope};
}

std::optional<Interval> Segment::box_bounds(const Domain& domain, const CentredBox& box) const {
  if (!domain.is_rigid) return std::nullopt;
  const NearestSphere sphere = nearest_sphere(*this, domain, box.centre);
  const dvec3 v = absolute(sphere.offset);
  const double m = glm::length(v), d = m - sphere.radius;
  // The lower bound holds because the distance is convex and lies above its tangent plane. The upper bound holds
  // because no sphere of the cone is nearer than the cone.
  const double fall = m > kLeastOffset * box.radius ? dot(v, box.half) / m : box.radius;
  return Interval{d - fall, glm::length(v + box.half) - sphere.radius};
}

}  // namespace isofield::blobtree::shapes
