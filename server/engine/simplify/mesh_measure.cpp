#include "engine/simplify/mesh_measure.h"

#include <algorithm>

namespace isofield::engine {

using blobtree::dvec3;

MeshMeasures measure(const Mesh& mesh) {
  MeshMeasures m;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const dvec3 p{mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]};
    m.bounds.add({p, p});
  }
  if (mesh.triangles.empty()) return m;
  // The tetrahedra have their apex in the middle of the mesh, because far from the origin their volumes would cancel.
  const dvec3 middle = (m.bounds.min + m.bounds.max) * 0.5;
  const auto vertex = [&](std::uint32_t v) {
    const float* p = &mesh.positions[3 * std::size_t{v}];
    return dvec3{p[0], p[1], p[2]} - middle;
  };
  dvec3 moment;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const dvec3 a = vertex(mesh.triangles[t]), b = vertex(mesh.triangles[t + 1]), c = vertex(mesh.triangles[t + 2]);
    const dvec3 normal = cross(b - a, c - a);
    const double volume = dot(a, normal) / 6;
    m.area += length(normal) / 2;
    m.volume += volume;
    moment = moment + (a + b + c) * (volume / 4);
  }
  if (m.volume > 0) m.centroid = middle + moment * (1 / m.volume);
  return m;
}

}  // namespace isofield::engine
