// Ellipsoid is a primitive: an ellipsoid with axis-parallel semi-axes. The origin of its own frame is its centre. Its
// distance is a lower bound outside and exact on the surface (scene.proto, Ellipsoid).
#pragma once

#include <algorithm>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Ellipsoid;
}

namespace isofield::blobtree::shapes {

struct Ellipsoid {
  static constexpr PrimitiveTraits kTraits{"ellipsoid", false};
  static Ellipsoid read(const v1::Ellipsoid& message, FieldReader& in, Affine& frame);

  dvec3 semi_axes;

  template <class V>
  typename V::value_type distance(const V& q) const {
    const double l = least();
    return length(V{q.x * (l / semi_axes.x), q.y * (l / semi_axes.y), q.z * (l / semi_axes.z)}) - l;
  }
  double least() const { return std::min({semi_axes.x, semi_axes.y, semi_axes.z}); }

  Ellipsoid scaled(double factor) const;
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
