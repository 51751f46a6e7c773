// Finds triangles of a mesh that meet other than where they share vertices. It uses CGAL with exact predicates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isofield::test_support {

// Returns the pairs of triangles, by number, that meet in more than the vertices and edges that they share. The mesh
// has 3 coordinates for each vertex and 3 indices for each triangle, and must be manifold. The time is about linear: a
// few seconds for a million triangles.
std::vector<std::pair<std::size_t, std::size_t>> self_intersections(std::span<const float> positions,
                                                                    std::span<const std::uint32_t> triangles);

}  // namespace isofield::test_support
