// Vectors of space, in double precision.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace isofield::blobtree {

// Without a value it is 0: GLM_FORCE_CTOR_INIT is defined for the whole server.
using dvec3 = glm::dvec3;

// The absolute values of the coordinates. glm::abs() branches on each sign, which the bounds of leaves would feel.
inline dvec3 absolute(const dvec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

}  // namespace isofield::blobtree
