// Segment is a primitive: a round cone, which is the convex hull of two spheres, one around the origin and one around
// (0, 0, length).
#pragma once

#include <algorithm>
#include <cmath>

#include "blobtree/primitives/kind.h"

namespace isofield::v1 {
class Segment;
}

namespace isofield::blobtree::shapes {

struct Segment {
  static constexpr PrimitiveTraits kTraits{"segment", false};
  static Segment read(const v1::Segment& message, FieldReader& in, Affine& frame);

  double length = 0, radius_a = 0, radius_b = 0;  // radius_a is at the origin

  // The cone is the union of a family of spheres. The sphere that is nearest to the point has the centre (0, 0, c).
  template <class V>
  typename V::value_type distance(const V& q) const {
    using std::max, std::min, std::sqrt;
    using T = typename V::value_type;
    const auto norm = [](const T& x, const T& y, const T& z) { return sqrt(x * x + y * y + z * z); };
    if (is_sphere()) return norm(q.x, q.y, q.z - T(sphere_centre())) - largest_radius();
    const double sin_tilt = (radius_a - radius_b) / length, tan_tilt = sin_tilt / std::sqrt(1 - sin_tilt * sin_tilt);
    const T rho = sqrt(q.x * q.x + q.y * q.y);
    const T c = min(max(q.z - rho * tan_tilt, T(0.0)), T(length));
    return norm(q.x, q.y, q.z - c) - (radius_a - c * sin_tilt);
  }
  // Returns whether the sphere of one end contains that of the other.
  bool is_sphere() const { return std::abs(radius_a - radius_b) >= length; }
  double sphere_centre() const { return radius_a >= radius_b ? 0 : length; }
  double largest_radius() const { return std::max(radius_a, radius_b); }

  Segment scaled(double factor) const;
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
