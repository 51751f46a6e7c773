// Box is a box with axis-parallel edges in double precision. Boxes hold the supports of fields and the regions over
// which culling bounds a field.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "blobtree/geometry/vec3.h"

namespace isofield::blobtree {

// A new box is empty until something is added to it.
struct Box {
  dvec3 min{std::numeric_limits<double>::infinity()};
  dvec3 max{-std::numeric_limits<double>::infinity()};

  // Returns the box that holds all of space.
  static Box everywhere() {
    return {dvec3(-std::numeric_limits<double>::infinity()), dvec3(std::numeric_limits<double>::infinity())};
  }

  // Returns whether the box is finite on every side. An empty box is not.
  bool is_bounded() const {
    const auto ends = [](double x) { return std::isfinite(x); };
    return ends(min.x) && ends(min.y) && ends(min.z) && ends(max.x) && ends(max.y) && ends(max.z);
  }
  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void add(const Box& other) {
    min = {std::min(min.x, other.min.x), std::min(min.y, other.min.y), std::min(min.z, other.min.z)};
    max = {std::max(max.x, other.max.x), std::max(max.y, other.max.y), std::max(max.z, other.max.z)};
  }
  bool operator==(const Box&) const = default;
  bool touches(const Box& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y &&
           min.z <= other.max.z && other.min.z <= max.z;
  }
};

// CentredBox describes a box by its centre and half its size, as the bounds of leaves need it.
struct CentredBox {
  explicit CentredBox(const Box& box)
      : centre((box.min + box.max) * 0.5), half((box.max - box.min) * 0.5), radius(length(half)) {}

  dvec3 centre, half;
  double radius;  // of the ball around the centre that holds the box
};

}  // namespace isofield::blobtree
