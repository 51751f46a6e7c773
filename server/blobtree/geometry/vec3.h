// Vectors of space, in double precision.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace isofield::blobtree {

// Without a value it is 0: GLM_FORCE_CTOR_INIT is defined for the whole server.
using dvec3 = glm::dvec3;

}  // namespace isofield::blobtree
