// The domain that stands before a leaf: the map from the world to the frame in which the leaf is defined. It is affine
// today; whatever comes in its place answers the same questions.
#pragma once

#include "blobtree/geometry/affine.h"

namespace isofield::blobtree {

// The point p of the world is the point to_local (p - anchor) of the leaf's frame.
struct Domain {
  dvec3 anchor;
  // The most that it stretches lengths, from the world to the leaf's frame: it bounds the slope of a distance.
  double stretch = 1;
  bool is_rigid = false;  // it keeps lengths
  Affine to_local;        // linear part only

  dvec3 point(const dvec3& p) const { return to_local.vector(p - anchor); }
};

}  // namespace isofield::blobtree
