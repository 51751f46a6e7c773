#include "blobtree/primitives/sphere.h"

#include <algorithm>
#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

Sphere Sphere::read(const v1::Sphere& message, FieldReader& in, Affine& frame) {
  frame = Affine::translation(in.point("center", message.center()));
  return {in.positive("radius", message.radius())};
}

Sphere Sphere::scaled(double factor) const {
  return {radius * factor};
}
double Sphere::largest() const {
  return radius;
}
double Sphere::least_radius() const {
  return radius;
}
double Sphere::area() const {
  return 4 * std::numbers::pi * radius * radius;
}
double Sphere::growth() const {
  return 1;
}

blobtree::Box Sphere::support(const Affine& to_world, double range) const {
  const double r = radius + range;
  return ellipsoid_image(to_world, {r, r, r});
}

Operand Sphere::operand(bool is_rigid) const {
  return is_rigid ? Operand::kSphere : Operand::kEllipsoid;
}

void Sphere::write(const Domain& domain, Slope slope, Operand operand, Float4* out) const {
  if (operand == Operand::kEllipsoid) return write_rows(domain, slope, radius, 0, 0, out);
  out[0] = {f32(domain.anchor.x), f32(domain.anchor.y), f32(domain.anchor.z), slope};
  out[1] = {f32(radius), 0, 0, 0};
}

}  // namespace isofield::blobtree::shapes
