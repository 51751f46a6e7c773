// Whether a mesh's triangles meet other than where they share vertices: by CGAL, with exact predicates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isofield::test_support {

// Pairs of triangles, by number, that meet in more than the vertices and edges that they share. 3 coordinates a vertex,
// 3 indices a triangle; the mesh is manifold. About linear, a few seconds a million triangles.
std::vector<std::pair<std::size_t, std::size_t>> self_intersections(std::span<const float> positions,
                                                                    std::span<const std::uint32_t> triangles);

}  // namespace isofield::test_support
