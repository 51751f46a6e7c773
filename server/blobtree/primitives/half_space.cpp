#include "blobtree/primitives/half_space.h"

#include <cmath>
#include <limits>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

HalfSpace HalfSpace::read(const v1::HalfSpace& message, FieldReader& in, Affine& frame) {
  const dvec3 point = in.point("point", message.point());
  const dvec3 normal = in.direction("normal", message.normal(), {0, 0, 1});
  if (in.status().ok()) frame = Affine::frame(point, normal);
  return {};
}

HalfSpace HalfSpace::scaled(double) const {
  return {};
}
double HalfSpace::largest() const {
  return 0;
}
double HalfSpace::own_lengths() const {
  return 0;
}
double HalfSpace::least_radius() const {
  return std::numeric_limits<double>::infinity();  // a half-space has no thin part
}
double HalfSpace::area() const {
  return 0;
}
double HalfSpace::growth() const {
  return 1;
}

blobtree::Box HalfSpace::support(const Affine& to_world, double range) const {
  blobtree::Box box = blobtree::Box::everywhere();
  const std::optional<Affine> inverse = to_world.inverse();
  if (!inverse) return box;
  // If the plane faces along an axis, the box ends along that axis, one range beyond the plane.
  const dvec3& normal = inverse->linear[2];
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0 || normal[(axis + 1) % 3] != 0 || normal[(axis + 2) % 3] != 0) continue;
    const double end = to_world.offset[axis] + range / normal[axis];
    (normal[axis] > 0 ? box.max : box.min)[axis] = end;
  }
  return box;
}

Operand HalfSpace::operand(bool) const {
  return Operand::kHalfSpace;
}

void HalfSpace::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  const dvec3& normal = domain.to_local.linear[2];
  out[0] = {f32(domain.anchor.x), f32(domain.anchor.y), f32(domain.anchor.z), slope};
  out[1] = {f32(normal.x), f32(normal.y), f32(normal.z), 0};
}

dvec3 HalfSpace::anchor(const Domain& domain) const {
  const dvec3& normal = domain.to_local.linear[2];
  return normal * (dot(normal, domain.anchor) / dot(normal, normal));
}

std::optional<Interval> HalfSpace::box_bounds(const Domain& domain, const CentredBox& box) const {
  const dvec3& normal = domain.to_local.linear[2];
  const double d = dot(normal, box.centre - domain.anchor), reach = dot(absolute(normal), box.half);
  return Interval{d - reach, d + reach};
}

}  // namespace isofield::blobtree::shapes
