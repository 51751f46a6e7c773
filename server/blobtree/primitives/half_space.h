// HalfSpace is a primitive: everything on one side of a plane, z <= 0. It is unbounded, so that a model which nothing
// else bounds is meshed within the bounds that a request states.
#pragma once

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class HalfSpace;
}

namespace isofield::blobtree::shapes {

struct HalfSpace {
  static constexpr PrimitiveTraits kTraits{"half_space", false};
  static HalfSpace read(const v1::HalfSpace& message, FieldReader& in, Affine& frame);

  template <class V>
  typename V::value_type distance(const V& q) const {
    return q.z;
  }
  HalfSpace scaled(double factor) const;
  double largest() const;
  double own_lengths() const;
  double least_radius() const;
  double area() const;
  double growth() const;
  blobtree::Box support(const Affine& to_world, double range) const;
  Operand operand(bool is_rigid) const;
  void write(const Domain& domain, Slope slope, Operand operand, Float4* out) const;
  // Returns the point of the plane that is nearest to the world's origin. The point that a scene states may lie
  // anywhere in the plane, and float32 would lose digits if its coordinates were large.
  dvec3 anchor(const Domain& domain) const;
  std::optional<Interval> box_bounds(const Domain& domain, const CentredBox& box) const;
};

}  // namespace isofield::blobtree::shapes
