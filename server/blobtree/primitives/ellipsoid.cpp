#include "blobtree/primitives/ellipsoid.h"

#include <algorithm>
#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

Ellipsoid Ellipsoid::read(const v1::Ellipsoid& message, FieldReader& in, Affine& frame) {
  const dvec3 axes = in.lengths("semi_axes", message.semi_axes());
  frame = Affine::translation(in.point("center", message.center()));
  return {axes};
}

Ellipsoid Ellipsoid::scaled(double factor) const {
  return {semi_axes * factor};
}
double Ellipsoid::largest() const {
  return std::max({semi_axes.x, semi_axes.y, semi_axes.z});
}
double Ellipsoid::own_lengths() const {
  return semi_axes.x + semi_axes.y;
}
double Ellipsoid::least_radius() const {
  return least();
}
double Ellipsoid::area() const {
  const dvec3& s = semi_axes;
  return 4.0 / 3 * std::numbers::pi * (s.x * s.y + s.y * s.z + s.z * s.x);
}
double Ellipsoid::growth() const {
  return largest() / least();
}

blobtree::Box Ellipsoid::support(const Affine& to_world, double range) const {
  return ellipsoid_image(to_world, semi_axes * (1 + range / least()));
}

Operand Ellipsoid::operand(bool) const {
  return Operand::kEllipsoid;
}

void Ellipsoid::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  // The record is that of a sphere of the least radius under a map that is scaled further.
  write_rows(domain, slope, least(), 0, 0, out);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[row + 1][column] *= f32(least() / semi_axes[row]);
  }
}

}  // namespace isofield::blobtree::shapes
