#include "mesh_files/crease_normals.h"

#include <algorithm>

namespace isofield {

CreaseNormals crease_normals(const Mesh& mesh) {
  const auto& [vertices, normals, corners] = mesh.creases;
  CreaseNormals out{.normals = mesh.normals, .corners = mesh.triangles};
  std::vector<bool> has_wedge(mesh.vertex_count());
  std::vector<std::uint32_t> rows;  // the row of each wedge in out.normals
  for (std::size_t wedge = 0; wedge < vertices.size(); ++wedge) {
    const std::uint32_t vertex = vertices[wedge];
    const float* normal = &normals[3 * wedge];
    if (!has_wedge[vertex]) {
      has_wedge[vertex] = true;
      rows.push_back(vertex);
      std::copy_n(normal, 3, &out.normals[3 * std::size_t{vertex}]);
    } else {
      rows.push_back(static_cast<std::uint32_t>(mesh.vertex_count() + out.vertices.size()));
      out.vertices.push_back(vertex);
      out.normals.insert(out.normals.end(), normal, normal + 3);
    }
  }
  for (std::size_t i = 0; i < corners.size(); i += 2) out.corners[corners[i]] = rows[corners[i + 1]];
  return out;
}

Mesh split_at_creases(Mesh mesh) {
  if (mesh.creases.vertices.empty()) return mesh;
  CreaseNormals split = crease_normals(mesh);
  mesh.positions.reserve(split.normals.size());
  for (const std::uint32_t v : split.vertices) {
    for (std::size_t i = 0; i < 3; ++i) mesh.positions.push_back(mesh.positions[3 * std::size_t{v} + i]);
  }
  mesh.normals = std::move(split.normals);
  mesh.triangles = std::move(split.corners);
  mesh.creases = {};
  return mesh;
}

}  // namespace isofield
