#include "blobtree/primitives/cylinder.h"

#include <algorithm>
#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

Cylinder Cylinder::read(const v1::Cylinder& message, FieldReader& in, Affine& frame) {
  const dvec3 a = in.stated_point("a", message.a()), b = in.stated_point("b", message.b());
  const dvec3 axis = b - a;
  const Cylinder c{glm::length(axis) / 2, in.positive("radius", message.radius())};
  if (c.half_length >= base::kMinLength) {
    frame = Affine::frame((a + b) * 0.5, axis);
  } else {
    in.refuse("b", "a", "a point that differs from a");
  }
  return c;
}

Cylinder Cylinder::scaled(double factor) const {
  return {half_length * factor, radius * factor};
}
double Cylinder::largest() const {
  return std::max(half_length, radius);
}
double Cylinder::own_lengths() const {
  return half_length + radius;
}
double Cylinder::least_radius() const {
  return std::min(half_length, radius);
}
double Cylinder::area() const {
  return 4 * std::numbers::pi * radius * half_length + 2 * std::numbers::pi * radius * radius;
}
double Cylinder::growth() const {
  return 1;
}

blobtree::Box Cylinder::support(const Affine& to_world, double range) const {
  return box_image(to_world, {radius + range, radius + range, half_length + range});
}

Operand Cylinder::operand(bool) const {
  return Operand::kCylinder;
}

void Cylinder::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  write_rows(domain, slope, half_length, radius, 0, out);
}

}  // namespace isofield::blobtree::shapes
