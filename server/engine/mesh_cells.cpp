#include "engine/mesh_cells.h"

#include <array>

namespace isofield::engine {
namespace {

std::uint64_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return x | std::uint64_t{y} << 21 | std::uint64_t{z} << 42;
}

template <class T>
void append_all(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<std::uint32_t> MeshJoiner::number(const MeshCells& part) {
  std::vector<std::uint32_t> triangles(part.corners.size());
  std::size_t corner = 0;
  for (const MeshBrick& b : part.bricks) {
    constexpr std::uint32_t kUnknown = ~0u;
    std::array<std::uint32_t, 8> first;
    first.fill(kUnknown);
    first[0] = vertices_;
    first_vertices_[key(b.x, b.y, b.z)] = vertices_;
    vertices_ += b.vertices;
    for (const std::size_t end = corner + 3 * std::size_t{b.triangles}; corner < end; ++corner) {
      const std::uint32_t c = part.corners[corner], below = c >> 24 & 7;
      if (first[below] == kUnknown) {
        first[below] = first_vertices_[key(b.x - (below & 1), b.y - (below >> 1 & 1), b.z - (below >> 2))];
      }
      triangles[corner] = first[below] + (c & 0xffffff);
    }
  }
  return triangles;
}

void MeshJoiner::append(const MeshCells& part, Mesh& mesh) {
  append_all(mesh.triangles, number(part));
  append_all(mesh.positions, part.positions);
  append_all(mesh.normals, part.normals);
  mesh.cells += part.cells;
}

}  // namespace isofield::engine
