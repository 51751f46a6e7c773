#include "blobtree/primitives/box.h"

#include <algorithm>

#include "blobtree/primitives/primitive.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree::shapes {

Box Box::read(const v1::Box& message, FieldReader& in, Affine& frame) {
  Box b;
  b.half = in.lengths("half_size", message.half_size());
  const double least = b.least_radius();
  frame = Affine::translation(in.point("center", message.center()));
  b.rounding = in.number("rounding", message.rounding(), 0, least,
                         absl::StrCat("a radius within [0, ", least, "], the smallest half size"));
  return b;
}

Box Box::scaled(double factor) const {
  return {half * factor, rounding * factor};
}
double Box::largest() const {
  return std::max({half.x, half.y, half.z, rounding});
}
double Box::own_lengths() const {
  return half.x + half.y;
}
double Box::least_radius() const {
  return std::min({half.x, half.y, half.z});
}
double Box::area() const {
  return 8 * (half.x * half.y + half.y * half.z + half.z * half.x);
}
double Box::growth() const {
  return 1;
}

blobtree::Box Box::support(const Affine& to_world, double range) const {
  return box_image(to_world, half + dvec3(range));
}

Operand Box::operand(bool) const {
  return Operand::kBox;
}

void Box::write(const Domain& domain, Slope slope, Operand, Float4* out) const {
  write_rows(domain, slope, half.x - rounding, half.y - rounding, half.z - rounding, out);
  out[4] = {f32(rounding), 0, 0, 0};
}

}  // namespace isofield::blobtree::shapes
