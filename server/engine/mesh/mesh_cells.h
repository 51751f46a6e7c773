// MeshCells holds a mesh, or a part of one, brick by brick. Triangles name their vertices by brick, so that a brick's
// data are the same whatever else is meshed. MeshJoiner makes a plain Mesh of them.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <array>
#include <cstdint>
#include <vector>

namespace isofield::engine {

struct Mesh {
  std::vector<float> positions, normals;  // 3 a vertex
  std::vector<std::uint32_t> triangles;   // 3 a triangle, counter-clockwise from outside
  std::uint64_t cells = 0;                // the number of cells in the bricks that were meshed
};

struct MeshBrick {
  std::uint32_t x, y, z;              // in bricks
  std::uint32_t vertices, triangles;  // how many it has
};

// Vertices and triangles are stored brick by brick. A triangle belongs to the brick of the lattice edge that its quad
// surrounds. Its vertices belong to that brick or to a neighbour with coordinates that are one less.
struct MeshCells {
  std::vector<MeshBrick> bricks;          // in order of place (comes_before()); bricks that hold nothing are left out
  std::vector<float> positions, normals;  // 3 a vertex; normals may be absent
  // 3 a triangle. Bits 0-23 are the vertex's number in its brick; bits 24-26 say which of x, y and z of that brick are
  // one less than those of the triangle's brick.
  std::vector<std::uint32_t> corners;
  std::uint64_t cells = 0;  // the number of cells in the bricks that were meshed
};

// The order of place: layers of this many bricks along z come one after the other, so that a mesh can be made and sent
// in layers, and within a layer the bricks have Morton order.
inline constexpr std::uint32_t kLayerBricks = 8;
// Returns true if brick `a` comes before brick `b` in the order of place. Both have members x, y and z.
template <class A, class B>
bool comes_before(const A& a, const B& b) {
  if (a.z / kLayerBricks != b.z / kLayerBricks) return a.z / kLayerBricks < b.z / kLayerBricks;
  // Morton order goes by the coordinate that differs in the highest bit, z before y before x among equals.
  const auto less_high_bit = [](std::uint32_t m, std::uint32_t n) { return m < n && m < (m ^ n); };
  std::uint32_t difference = a.z ^ b.z;
  bool is_before = a.z < b.z;
  if (less_high_bit(difference, a.y ^ b.y)) difference = a.y ^ b.y, is_before = a.y < b.y;
  if (less_high_bit(difference, a.x ^ b.x)) is_before = a.x < b.x;
  return is_before;
}

// Numbers the vertices of a whole mesh from its parts. The parts must come in order of place, from the first brick of
// the mesh on. Not thread-safe.
class MeshJoiner {
 public:
  // Returns the triangles of `part` by numbers of vertices in the whole mesh.
  std::vector<std::uint32_t> number(const MeshCells& part);
  // Calls visit(corner, vertex) for each corner of these triangles.
  template <class Visit>
  void for_each_corner(const MeshCells& part, Visit&& visit);
  // Appends the part to `mesh`.
  void append(const MeshCells& part, Mesh& mesh);

  std::uint32_t vertices() const { return vertices_; }

 private:
  static std::uint64_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return x | std::uint64_t{y} << 21 | std::uint64_t{z} << 42;
  }

  absl::flat_hash_map<std::uint64_t, std::uint32_t> first_vertices_;  // by brick
  std::uint32_t vertices_ = 0;
};

template <class Visit>
void MeshJoiner::for_each_corner(const MeshCells& part, Visit&& visit) {
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
      visit(corner, first[below] + (c & 0xffffff));
    }
  }
}

}  // namespace isofield::engine
