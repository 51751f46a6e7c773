#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace isofield {

// Returns the vector scaled to length 1, or (0, 0, 1) if it has no length.
inline glm::vec3 unit_vector(const glm::vec3& a) {
  const float length = glm::length(a);
  return length > 0 ? a * (1 / length) : glm::vec3(0, 0, 1);
}

}  // namespace isofield
