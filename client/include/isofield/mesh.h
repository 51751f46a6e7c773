#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "isofield/v1/mesh_service.pb.h"

namespace isofield {

// A triangle mesh in model units; triangles are counter-clockwise seen from outside.
struct Mesh {
  // [n, 3] each: x, y, z; normals are unit vectors, empty where the request omitted them.
  std::vector<float> positions;
  std::vector<float> normals;
  // [m, 3]: vertex numbers.
  std::vector<std::uint32_t> triangles;
  // Normals for the sides of creases, as v1::MeshCreases has them; empty unless the request asked for them.
  struct Creases {
    std::vector<std::uint32_t> vertices;  // [w]: of each wedge
    std::vector<float> normals;           // [w, 3]
    std::vector<std::uint32_t> corners;   // [c, 2]: 3 t + i for corner i of triangle t, and its wedge
  };
  Creases creases;
  v1::MeshSummary summary;

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

// A mesh by the bricks of its lattice (mesh_service.proto, MeshBricks): kept while bricks come and go, joined to plain
// arrays where those are needed. One thread at a time.
class BrickMesh {
 public:
  // x, y, z in bricks from the lattice's origin.
  using Place = std::array<std::uint32_t, 3>;

  // Adds bricks, in place of those that are there.
  // INTERNAL: the arrays do not fit the table of the bricks, or a corner names a vertex that its own brick has not, or
  // a brick before the lattice's first; nothing is changed then.
  absl::Status apply(const v1::MeshBricks& bricks);
  // Adds the bricks of another part of the same mesh, in place of those that are there.
  void add(const BrickMesh& part);
  // Forgets bricks: UINT32, shape [n, 3], as in MeshUpdate.
  // INTERNAL: not such an array, or one of them is not there; nothing is changed then.
  absl::Status remove(const v1::Tensor& places);
  void clear();

  std::size_t brick_count() const { return bricks_.size(); }
  std::size_t vertex_count() const { return vertices_; }
  std::size_t triangle_count() const { return triangles_; }

  // The mesh, its vertices and triangles in the order of the bricks' places: of a whole mesh the arrays that
  // Client::mesh returns, bit for bit. Of the summary, the counts are set.
  // INTERNAL: a corner names a vertex that is not there (a part whose neighbours have not been added has such ones), or
  // some vertices have normals and some have not.
  absl::StatusOr<Mesh> join() const;

 private:
  // floor(z / 8), then the Morton code with z's bits above y's above x's.
  struct InOrder {
    bool operator()(const Place& a, const Place& b) const;
  };
  // As in v1::MeshBricks.
  struct Brick {
    std::vector<float> positions, normals;
    std::vector<std::uint32_t> corners;
  };
  void put(const Place& place, Brick brick);
  void forget(const Place& place);

  std::map<Place, Brick, InOrder> bricks_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

// A mesh or a part of it, as a server made it.
struct MeshedBricks {
  BrickMesh bricks;
  // Counts are of the part.
  v1::MeshSummary summary;
};

}  // namespace isofield
