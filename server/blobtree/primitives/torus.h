// Torus is a primitive: a torus around the z axis. The origin of its own frame is its centre.
#pragma once

#include <cmath>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Torus;
}

namespace isofield::blobtree::shapes {

struct Torus {
  static constexpr PrimitiveTraits kTraits{"torus", false};
  static Torus read(const v1::Torus& message, FieldReader& in, Affine& frame);

  double major_radius = 0, minor_radius = 0;

  template <class V>
  typename V::value_type distance(const V& q) const {
    using std::sqrt;
    using T = typename V::value_type;
    const T ring = sqrt(q.x * q.x + q.y * q.y) - major_radius;
    return sqrt(ring * ring + q.z * q.z) - minor_radius;
  }
  Torus scaled(double factor) const;
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
