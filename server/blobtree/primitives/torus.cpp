#include "blobtree/primitives/torus.h"

#include <algorithm>
#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

Torus Torus::read(const v1::Torus& message, FieldReader& in, Affine& frame) {
  const dvec3 center = in.point("center", message.center());
  const dvec3 axis = in.direction("axis", message.axis(), {0, 0, 1});
  const Torus t{in.positive("major_radius", message.major_radius()),
                in.positive("minor_radius", message.minor_radius())};
  if (in.status().ok()) frame = Affine::frame(center, axis);
  return t;
}

Torus Torus::scaled(double factor) const {
  return {major_radius * factor, minor_radius * factor};
}
double Torus::largest() const {
  return std::max(major_radius, minor_radius);
}
double Torus::own_lengths() const {
  return major_radius + minor_radius;
}
double Torus::least_radius() const {
  return minor_radius;
}
double Torus::area() const {
  return 4 * std::numbers::pi * std::numbers::pi * major_radius * minor_radius;
}
double Torus::growth() const {
  return 1;
}

blobtree::Box Torus::support(const Affine& to_world, double range) const {
  const double outer = major_radius + minor_radius + range;
  return box_image(to_world, {outer, outer, minor_radius + range});
}

Operand Torus::operand(bool) const {
  return Operand::kTorus;
}

void Torus::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  write_rows(domain, slope, major_radius, minor_radius, 0, out);
}

}  // namespace isofield::blobtree::shapes
