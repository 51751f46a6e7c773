// Box is a primitive: a box with axis-parallel edges, which may be rounded. The origin of its own frame is its centre.
#pragma once

#include <algorithm>
#include <cmath>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Box;
}

namespace isofield::blobtree::shapes {

struct Box {
  static constexpr PrimitiveTraits kTraits{"box", true};
  static Box read(const v1::Box& message, FieldReader& in, Affine& frame);

  dvec3 half;
  double rounding = 0;  // radius of the rounded edges, which lie within the half size

  template <class V>
  typename V::value_type distance(const V& q) const {
    using std::abs, std::max, std::min, std::sqrt;
    using T = typename V::value_type;
    const T x = abs(q.x) - (half.x - rounding), y = abs(q.y) - (half.y - rounding), z = abs(q.z) - (half.z - rounding);
    const T inside = min(max(x, max(y, z)), T(0.0));
    const T px = max(x, T(0.0)), py = max(y, T(0.0)), pz = max(z, T(0.0));
    return sqrt(px * px + py * py + pz * pz) + inside - rounding;
  }
  Box scaled(double factor) const;
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
