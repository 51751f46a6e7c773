// Domain is the map from the world to the frame in which a leaf is defined. It is affine today; a map of another kind
// has to answer the same questions.
#pragma once

#include "blobtree/geometry/affine.h"

namespace isofield::blobtree {

// The map takes the point p of the world to the point to_local (p - anchor) of the leaf's frame.
struct Domain {
  dvec3 anchor;
  // The largest factor by which the map stretches lengths, from the world to the leaf's frame. It bounds the slope of a
  // distance.
  double stretch = 1;
  bool is_rigid = false;  // the map keeps lengths
  Affine to_local;        // its offset stays 0

  dvec3 point(const dvec3& p) const { return to_local.vector(p - anchor); }
};

}  // namespace isofield::blobtree
