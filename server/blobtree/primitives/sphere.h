// A sphere around the origin.
#pragma once

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
  double own_lengths() const;
  double least_radius() const;
  double area() const;
  double growth() const;
  blobtree::Box support(const Affine& to_world, double range) const;
  Operand operand(bool is_rigid) const;
  void write(const Domain& domain, Slope slope, Operand operand, Float4* out) const;
  std::optional<Interval> box_bounds(const Domain& domain, const CentredBox& box) const;
};

}  // namespace isofield::blobtree::shapes
