// Which sides of triangles lie against each other, and where triangles face: what tells creases.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "blobtree/geometry/vec3.h"

namespace isofield::engine {

// The cosine of 25 degrees: triangles that turn by more at the edge between them may be the two sides of a crease.
inline constexpr double kCreaseCosine = 0.9063077870366499;

inline constexpr std::uint32_t kNoTwin = std::numeric_limits<std::uint32_t>::max();

// Sides are named by the corner at which they begin, and `corners` has the vertex of each corner, below `vertices`.
// Returns for each side the one that lies against it in the triangle beside; kNoTwin where there is none.
std::vector<std::uint32_t> find_twins(std::span<const std::uint32_t> corners, std::size_t vertices);

// Returns the unit normal of each triangle. Thin triangles, whose own direction says nothing, take that of the triangle
// at their longest edge; (0, 0, 0) where that has no area either.
std::vector<blobtree::dvec3> face_directions(std::span<const float> positions, std::span<const std::uint32_t> corners,
                                             std::span<const std::uint32_t> twins);

}  // namespace isofield::engine
