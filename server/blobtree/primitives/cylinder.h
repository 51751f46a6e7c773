// Cylinder is a primitive: a solid cylinder around the z axis with flat ends. The origin of its own frame is its
// centre.
#pragma once

#include <algorithm>
#include <cmath>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Cylinder;
}

namespace isofield::blobtree::shapes {

struct Cylinder {
  static constexpr PrimitiveTraits kTraits{"cylinder", true};
  static Cylinder read(const v1::Cylinder& message, FieldReader& in, Affine& frame);

  double half_length = 0, radius = 0;

  template <class V>
  typename V::value_type distance(const V& q) const {
    using std::abs, std::max, std::min, std::sqrt;
    using T = typename V::value_type;
    const T side = sqrt(q.x * q.x + q.y * q.y) - radius, end = abs(q.z) - half_length;
    const T outside_side = max(side, T(0.0)), outside_end = max(end, T(0.0));
    return min(max(side, end), T(0.0)) + sqrt(outside_side * outside_side + outside_end * outside_end);
  }
  Cylinder scaled(double factor) const;
  double largest() const;
  double own_lengths() const;
  double least_radius() const;
  double area() const;
  double growth() const;
  blobtree::Box support(const Affine& to_world, double range) const;
  Operand operand(bool is_rigid) const;
  void write(const Domain& domain, Slope slope, Operand operand, Float4* out) const;
};

}  // namespace isofield::blobtree::shapes
