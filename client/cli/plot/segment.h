#pragma once

#include <glm/vec2.hpp>

namespace isofield {

// A point of a plot or of a function's domain.
using Point = glm::dvec2;
// A straight part of a curve.
struct Segment {
  Point a{}, b{};
};

}  // namespace isofield
