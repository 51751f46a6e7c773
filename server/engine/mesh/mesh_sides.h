// Finds the twins of half-edges and the directions in which triangles face, from which creases are found.
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

// Returns the twin half-edge of each half-edge, which lies in the neighbouring triangle, or kNoTwin. Half-edges are
// named by the corner at which they begin. `corners` has the vertex number of each corner, less than `vertices`.
std::vector<std::uint32_t> find_twins(std::span<const std::uint32_t> corners, std::size_t vertices);

// Returns the unit normal of each triangle. The direction of a thin triangle is unreliable, and so it takes that of the
// triangle at its longest edge; (0, 0, 0) if that has no area either.
std::vector<blobtree::dvec3> face_directions(std::span<const float> positions, std::span<const std::uint32_t> corners,
                                             std::span<const std::uint32_t> twins);

}  // namespace isofield::engine
