#include "support/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>

namespace isofield::test_support {

std::vector<std::pair<std::size_t, std::size_t>> self_intersections(std::span<const float> positions,
                                                                    std::span<const std::uint32_t> triangles) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface mesh;
  for (std::size_t v = 0; v + 2 < positions.size(); v += 3) {
    mesh.add_vertex(Kernel::Point_3(positions[v], positions[v + 1], positions[v + 2]));
  }
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    mesh.add_face(Surface::Vertex_index(triangles[t]), Surface::Vertex_index(triangles[t + 1]),
                  Surface::Vertex_index(triangles[t + 2]));
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> faces;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(faces));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [a, b] : faces) pairs.emplace_back(a.idx(), b.idx());
  return pairs;
}

}  // namespace isofield::test_support
