#pragma once

#include <glm/vec2.hpp>

namespace isofield {

// A point of a plot or of a function's domain.
using Point = glm::dvec2;
struct Segment {
  Point a{}, b{};
};

}  // namespace isofield
