// Cone is a primitive: a solid cone around the z axis with flat ends, which is a frustum, or has a tip if one radius is
// 0. The origin of its own frame is the middle of its axis.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/value_of.h"
#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Cone;
}

namespace isofield::blobtree::shapes {

struct Cone {
  static constexpr PrimitiveTraits kTraits{"cone", true};
  static Cone read(const v1::Cone& message, FieldReader& in, Affine& frame);

  double half_length = 0, radius_a = 0, radius_b = 0;  // radius_a is at z = -half_length

  // The distance is exact everywhere. In the half-plane of (rho, z), where rho is the distance from the axis, the solid
  // is a trapezoid: a point is nearest to an end, to the side, or to one of the two rims between them.
  template <class V>
  typename V::value_type distance(const V& q) const {
    using base::value_of, std::max, std::sqrt;
    using T = typename V::value_type;
    const Side s = side();
    const T rho = sqrt(q.x * q.x + q.y * q.y);
    const T from_a = rho - T(radius_a), up_from_a = q.z + T(half_length);  // offsets from the rim of radius_a
    const T from_b = rho - T(radius_b), above = q.z - T(half_length);      // offsets from the rim of radius_b
    const T off_side = from_a * T(s.normal_rho) + up_from_a * T(s.normal_z);
    const T along_side = up_from_a * T(s.normal_rho) - from_a * T(s.normal_z);
    if (value_of(above) > 0 && value_of(rho) <= radius_b) return above;
    if (value_of(up_from_a) < 0 && value_of(rho) <= radius_a) return T(0.0) - up_from_a;
    const T deepest = max(off_side, max(above, T(0.0) - up_from_a));
    if (value_of(deepest) <= 0) return deepest;
    if (value_of(along_side) <= 0) return sqrt(from_a * from_a + up_from_a * up_from_a);
    if (value_of(along_side) >= s.length) return sqrt(from_b * from_b + above * above);
    return off_side;
  }

  // Side is the line of the solid's side in that half-plane, from the rim of radius_a to the rim of radius_b: its
  // outward normal and its length.
  struct Side {
    double normal_rho, normal_z, length;
  };
  Side side() const {
    const double drop = radius_a - radius_b, length = std::hypot(2 * half_length, drop);
    return {2 * half_length / length, drop / length, length};
  }

  Cone scaled(double factor) const;
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
