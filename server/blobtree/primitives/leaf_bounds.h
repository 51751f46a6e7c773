// Bounds of a leaf's distance over a box.
#pragma once

#include "blobtree/cull/intervals.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// A box by its centre.
struct CentredBox {
  explicit CentredBox(const Box& box)
      : centre((box.min + box.max) * 0.5), half((box.max - box.min) * 0.5), radius(length(half)) {}

  dvec3 centre, half;
  double radius;  // of the ball that holds it
};

// Of leaf.distance(), and of what float32 makes of it on the device.
Interval distance_bounds(const Leaf& leaf, const CentredBox& box);

// Whether a positive leaf's field is 0 throughout the box.
bool vanishes(const Leaf& leaf, const Box& box);

}  // namespace isofield::blobtree
