// Sphere is a primitive: a sphere around the origin.
#pragma once

#include <algorithm>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Sphere;
}

namespace isofield::blobtree::shapes {

struct Sphere {
  static constexpr PrimitiveTraits kTraits{"sphere", false};
  static Sphere read(const v1::Sphere& message, FieldReader& in, Affine& frame);

  double radius = 0;

  template <class V>
  typename V::value_type distance(const V& q) const {
    return length(q) - radius;
  }
  Sphere scaled(double factor) const;
  double largest() const;
  double own_lengths() const { return radius; }
  double least_radius() const;
  double area() const;
  double growth() const;
  blobtree::Box support(const Affine& to_world, double range) const;
  Operand operand(bool is_rigid) const;
  void write(const Domain& domain, Slope slope, Operand operand, Float4* out) const;
  std::optional<Interval> box_bounds(const Domain& domain, const CentredBox& box) const;
};

// This function is inline because most scenes consist of spheres and culling calls it for each brick: the call would
// cost as much as the work.
inline std::optional<Interval> Sphere::box_bounds(const Domain& domain, const CentredBox& box) const {
  if (!domain.is_rigid) return std::nullopt;
  const dvec3 v = absolute(box.centre - domain.anchor), n = v - box.half;
  const dvec3 nearest{std::max(n.x, 0.0), std::max(n.y, 0.0), std::max(n.z, 0.0)};
  return Interval{length(nearest) - radius, length(v + box.half) - radius};
}

}  // namespace isofield::blobtree::shapes
