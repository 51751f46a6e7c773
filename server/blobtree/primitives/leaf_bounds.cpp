#include "blobtree/primitives/leaf_bounds.h"

#include <algorithm>
#include <cmath>

namespace isofield::blobtree {
namespace {

// What float32 evaluation of a length may differ from exact arithmetic, relative to the coordinates it is computed
// from.
constexpr double kLengthRoom = 1e-6;
// A vector shorter than this times the box has no direction to rely on.
constexpr double kLeastOffset = 1e-6;

dvec3 absolute(const dvec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

// The sphere of those that span a rigidly placed round cone whose distance from p is the least: that distance is the
// cone's. `offset` leads from its centre to p, in the world.
struct NearestSphere {
  dvec3 offset;
  double radius;
};
NearestSphere nearest_sphere(const Leaf& leaf, const dvec3& p) {
  const ShapeSize& s = leaf.size;
  const dvec3 v = p - leaf.anchor;
  const dvec3& axis = leaf.to_local.linear[2];
  const double drop = s[1] - s[2];
  if (std::abs(drop) >= s[0]) return {drop >= 0 ? v : v - axis * s[0], std::max(s[1], s[2])};
  const double sin_tilt = drop / s[0], tan_tilt = sin_tilt / std::sqrt(1 - sin_tilt * sin_tilt);
  const double y = dot(axis, v);
  const double c = std::clamp(y - length(v - axis * y) * tan_tilt, 0.0, s[0]);
  return {v - axis * c, s[1] - c * sin_tilt};
}

// From exact arithmetic.
Interval exact_bounds(const Leaf& leaf, const CentredBox& box) {
  if (leaf.operand == Operand::kSphere) {
    const dvec3 v = absolute(box.centre - leaf.anchor), n = v - box.half;
    const dvec3 nearest{std::max(n.x, 0.0), std::max(n.y, 0.0), std::max(n.z, 0.0)};
    return {length(nearest) - leaf.size[0], length(v + box.half) - leaf.size[0]};
  }
  if (leaf.operand == Operand::kSegment) {
    const NearestSphere sphere = nearest_sphere(leaf, box.centre);
    const dvec3 v = absolute(sphere.offset);
    const double m = length(v), d = m - sphere.radius;
    // The distance is convex and lies above its tangent plane; no sphere of the cone is nearer than it is.
    const double fall = m > kLeastOffset * box.radius ? dot(v, box.half) / m : box.radius;
    return {d - fall, length(v + box.half) - sphere.radius};
  }
  const double d = leaf.distance(box.centre), reach = box.radius * leaf.stretch;
  return {d - reach, d + reach};
}

}  // namespace

Interval distance_bounds(const Leaf& leaf, const CentredBox& box) {
  const dvec3 c = absolute(box.centre);
  const double size = std::max({c.x, c.y, c.z, box.radius}) * leaf.stretch;
  const double room = kLengthRoom * (size + leaf.range + leaf.size[0] + leaf.size[1]);
  const Interval d = exact_bounds(leaf, box);
  return {d.lo - room, d.hi + room};
}

bool vanishes(const Leaf& leaf, const Box& box) {
  return !leaf.support.touches(box) || distance_bounds(leaf, CentredBox(box)).lo >= leaf.range;
}

}  // namespace isofield::blobtree
