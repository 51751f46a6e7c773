#include "blobtree/primitives/cone.h"

#include <numbers>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {
namespace {

// Reads the radius of an end, which may be 0.
double read_radius(const char* field, double radius, FieldReader& in) {
  if (radius == 0) return 0;
  return in.positive(field, radius);
}

}  // namespace

Cone Cone::read(const v1::Cone& message, FieldReader& in, Affine& frame) {
  const dvec3 a = in.stated_point("a", message.a()), b = in.stated_point("b", message.b());
  const dvec3 axis = b - a;
  Cone c;
  c.half_length = glm::length(axis) / 2;
  c.radius_a = read_radius("radius_a", message.radius_a(), in);
  c.radius_b = read_radius("radius_b", message.radius_b(), in);
  if (c.radius_a == 0 && c.radius_b == 0) in.refuse("radius_a", "0", "a radius > 0 at one end at least");
  if (c.half_length < base::kMinLength) {
    in.refuse("b", "a", "a point that differs from a");
  } else {
    frame = Affine::frame((a + b) * 0.5, axis);
  }
  return c;
}

Cone Cone::scaled(double factor) const {
  return {half_length * factor, radius_a * factor, radius_b * factor};
}
double Cone::largest() const {
  return std::max({half_length, radius_a, radius_b});
}
double Cone::own_lengths() const {
  return half_length + radius_a + radius_b;
}
double Cone::least_radius() const {
  // A tip has no thickness, so the feature size is that of the solid as a whole.
  return std::min(half_length, (radius_a + radius_b) / 2);
}
double Cone::area() const {
  return std::numbers::pi * ((radius_a + radius_b) * side().length + radius_a * radius_a + radius_b * radius_b);
}
double Cone::growth() const {
  return 1;
}

blobtree::Box Cone::support(const Affine& to_world, double range) const {
  // The box holds two discs, each of which grows by the range on all sides.
  const auto disc = [&](double z, double radius) {
    Affine at = to_world;
    at.offset = to_world.point({0, 0, z});
    return box_image(at, {radius + range, radius + range, range});
  };
  blobtree::Box box = disc(-half_length, radius_a);
  box.add(disc(half_length, radius_b));
  return box;
}

Operand Cone::operand(bool) const {
  return Operand::kCone;
}

void Cone::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  const Side s = side();
  write_rows(domain, slope, half_length, radius_a, radius_b, out);
  out[4] = {f32(s.normal_rho), f32(s.normal_z), f32(s.length), 0};
}

}  // namespace isofield::blobtree::shapes
