#include "engine/mesh/crease_wedges.h"

#include <numeric>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/mesh_sides.h"

namespace isofield::engine {

CreaseWedges crease_wedges(const Mesh& mesh) {
  const auto corner_count = static_cast<std::uint32_t>(mesh.triangles.size());
  const std::vector<std::uint32_t> twins = find_twins(mesh.triangles, mesh.positions.size() / 3);
  const std::vector<blobtree::dvec3> directions = face_directions(mesh.positions, mesh.triangles, twins);
  DisjointSets corners(corner_count);  // smooth edges join the corners at their ends
  for (std::uint32_t c = 0; c < corner_count; ++c) {
    const std::uint32_t d = twins[c];
    if (d == kNoTwin || d < c || dot(directions[c / 3], directions[d / 3]) <= kCreaseCosine) continue;
    corners.join(c, next_corner(d));
    corners.join(next_corner(c), d);
  }
  CreaseWedges wedges;
  wedges.vertices.resize(mesh.positions.size() / 3);
  std::iota(wedges.vertices.begin(), wedges.vertices.end(), 0u);
  std::vector<bool> is_taken(wedges.vertices.size());
  std::vector<std::uint32_t> wedge_of(corner_count);
  wedges.triangles.resize(corner_count / 3);
  for (std::uint32_t c = 0; c < corner_count; ++c) {
    const std::uint32_t vertex = mesh.triangles[c];
    if (const std::uint32_t first = corners.root(c); first != c) {
      wedge_of[c] = wedge_of[first];
    } else if (!is_taken[vertex]) {
      is_taken[vertex] = true;
      wedge_of[c] = vertex;
    } else {
      wedge_of[c] = static_cast<std::uint32_t>(wedges.vertices.size());
      wedges.vertices.push_back(vertex);
    }
    wedges.triangles[c / 3][c % 3] = wedge_of[c];
  }
  return wedges;
}

}  // namespace isofield::engine
