#include "engine/mesh/mesh_cells.h"

namespace isofield::engine {
namespace {

template <class T>
void append_all(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<std::uint32_t> MeshJoiner::number(const MeshCells& part) {
  std::vector<std::uint32_t> triangles(part.corners.size());
  for_each_corner(part, [&](std::size_t corner, std::uint32_t vertex) { triangles[corner] = vertex; });
  return triangles;
}

void MeshJoiner::append(const MeshCells& part, Mesh& mesh) {
  append_all(mesh.triangles, number(part));
  append_all(mesh.positions, part.positions);
  append_all(mesh.normals, part.normals);
  mesh.cells += part.cells;
}

}  // namespace isofield::engine
