// dvec3 is a point or a vector of space in double precision.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace isofield::blobtree {

// A vector without a value is 0, because GLM_FORCE_CTOR_INIT is defined for the whole server.
using dvec3 = glm::dvec3;

// Returns the vector of the coordinates' absolute values. glm::abs() branches on each sign, which makes the bounds of
// leaves slower.
inline dvec3 absolute(const dvec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

}  // namespace isofield::blobtree
