// These functions tell how far a scene's field reaches.
#pragma once

#include <algorithm>

#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// Returns the longest edge of a box, which must not be empty.
inline double longest_edge(const Box& box) {
  return std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
}

// Returns whether the scene bounds its field by itself. A scene without any field is bounded.
inline bool is_bounded(const Tape& tape) {
  return tape.support.empty() || tape.support.is_bounded();
}

}  // namespace isofield::blobtree
