// Functions on the triangles of a mesh: their corners, positions and normals.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "blobtree/geometry/vec3.h"

namespace isofield::engine {

using Triangle = std::array<std::uint32_t, 3>;  // vertex numbers, counter-clockwise from outside

// Corners are numbered three a triangle. Returns the corner that follows in the same triangle.
constexpr std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

inline blobtree::dvec3 position_of(std::span<const float> positions, std::uint32_t vertex) {
  const float* p = &positions[3 * std::size_t{vertex}];
  return {p[0], p[1], p[2]};
}

// Returns a normal of the triangle, with twice the triangle's area as its length.
inline blobtree::dvec3 normal_of(std::span<const float> positions, const Triangle& t) {
  const blobtree::dvec3 a = position_of(positions, t[0]);
  return cross(position_of(positions, t[1]) - a, position_of(positions, t[2]) - a);
}

}  // namespace isofield::engine
