#include "blobtree/primitives/kind.h"

#include <cmath>

namespace isofield::blobtree {
namespace {

template <class Extent>
Box around(const Affine& to_world, const dvec3& half, Extent extent) {
  const auto along = [&](const dvec3& row) { return extent(dvec3{row.x * half.x, row.y * half.y, row.z * half.z}); };
  const dvec3 reach{along(to_world.linear[0]), along(to_world.linear[1]), along(to_world.linear[2])};
  return {to_world.offset - reach, to_world.offset + reach};
}

}  // namespace

Box box_image(const Affine& to_world, const dvec3& half) {
  return around(to_world, half, [](const dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); });
}

Box ellipsoid_image(const Affine& to_world, const dvec3& semi_axes) {
  return around(to_world, semi_axes, [](const dvec3& v) { return length(v); });
}

}  // namespace isofield::blobtree
