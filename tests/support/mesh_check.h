// Checks whether an indexed triangle mesh bounds a solid. The check shares no code with the mesher.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isofield::test_support {

// The figures that check_mesh() finds for one mesh.
struct MeshReport {
  std::size_t vertices = 0;  // only the vertices that triangles use
  std::size_t triangles = 0;
  std::size_t unused_vertices = 0;
  // Triangles with an index beyond the vertices, and triangles that use one index twice. The figures below leave both
  // out.
  std::size_t bad_indices = 0;
  std::size_t degenerate_triangles = 0;
  // Vertices with a coordinate that is not finite.
  std::size_t not_finite = 0;
  // Triangles of three different vertices that are flat: twice the area <= 1e-12 of the longest edge's square.
  std::size_t zero_area = 0;
  // Undirected edges that are faulty: one triangle uses an open edge, two triangles use a flipped edge in the same
  // direction, and more than two triangles use a crowded edge.
  std::size_t open_edges = 0;
  std::size_t flipped_edges = 0;
  std::size_t crowded_edges = 0;
  // Vertices around which the triangles, joined along shared edges, form more than one fan.
  std::size_t pinched_vertices = 0;
  std::size_t components = 0;
  std::int64_t euler = 0;  // vertices - edges + triangles
  double volume = 0;       // signed: positive where triangles turn counterclockwise seen from outside

  // True if every directed edge has its opposite exactly once.
  bool closed() const { return open_edges == 0 && flipped_edges == 0 && crowded_edges == 0; }
  bool manifold() const { return closed() && pinched_vertices == 0; }
  bool sound() const {
    return triangles > 0 && bad_indices == 0 && degenerate_triangles == 0 && not_finite == 0 && manifold() &&
           volume > 0;
  }
  // The number of handles of all components together. It is meaningful for manifold meshes only.
  std::int64_t genus() const { return static_cast<std::int64_t>(components) - euler / 2; }
  // Returns one line with every figure.
  std::string text() const;
};

// Checks a mesh with 3 coordinates for each vertex and 3 indices for each triangle; it ignores what is left over of
// either. The time is about linear in the size, because the check sorts the edges.
MeshReport check_mesh(std::span<const float> positions, std::span<const std::uint32_t> indices);

}  // namespace isofield::test_support
