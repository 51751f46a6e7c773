// Triangle meshes as the client returns them: plain arrays (Mesh), or the bricks of the lattice on which the server
// made the mesh (BrickMesh).
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

// A triangle mesh in model units. The triangles are counter-clockwise seen from outside.
struct Mesh {
  // Shape [n, 3] each. Normals are unit vectors; there are none if the request left them out.
  std::vector<float> positions;
  std::vector<float> normals;
  // Shape [m, 3]: the numbers of the vertices, from 0.
  std::vector<std::uint32_t> triangles;
  // The normals of the sides of creases. The triangles around a vertex on a crease fall into wedges, and each wedge has
  // a normal of its own (v1::MeshCreases). The arrays are empty unless the request asked for them.
  struct Creases {
    std::vector<std::uint32_t> vertices;  // [w]: the vertex of each wedge
    std::vector<float> normals;           // [w, 3]: the normal of each wedge
    std::vector<std::uint32_t> corners;   // [c, 2]: 3 t + i for corner i of triangle t, and its wedge
  };
  Creases creases;
  v1::MeshSummary summary;

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

// A mesh as the bricks of its lattice (v1::MeshBricks in mesh_service.proto). Bricks can be added, replaced and
// removed, and join() makes plain arrays of them. Only one thread at a time may use a BrickMesh.
class BrickMesh {
 public:
  // The x, y and z of a brick, counted in bricks from the origin of the lattice.
  using Place = std::array<std::uint32_t, 3>;

  // Adds bricks, and replaces those that are at the same places.
  // INTERNAL: the arrays do not fit the table of the bricks, or a corner names a vertex that its own brick does not
  // have, or a brick before the first one of the lattice. The mesh is then unchanged.
  absl::Status apply(const v1::MeshBricks& bricks);
  // Adds the bricks of another part of the same mesh, and replaces those that are at the same places.
  void add(const BrickMesh& part);
  // Removes bricks. `places` is a UINT32 array of shape [n, 3], as in v1::MeshUpdate.
  // INTERNAL: it is no such array, or there is no brick at one of the places. The mesh is then unchanged.
  absl::Status remove(const v1::Tensor& places);
  // Removes all bricks.
  void clear();

  std::size_t brick_count() const { return bricks_.size(); }
  std::size_t vertex_count() const { return vertices_; }
  std::size_t triangle_count() const { return triangles_; }

  // Joins the bricks to plain arrays, in the order of their places. For a whole mesh these are the arrays that
  // Client::mesh() returns, bit for bit. Only the counts of the summary are set.
  // INTERNAL: a corner names a vertex that is not there, as in a part of a mesh whose neighbours have not been added,
  // or some vertices have normals and others have none.
  absl::StatusOr<Mesh> join() const;

 private:
  // The order of the bricks in the joined mesh: by floor(z / 8), then by the Morton code with the bits of z above those
  // of y above those of x.
  struct InOrder {
    bool operator()(const Place& a, const Place& b) const;
  };
  // The arrays of one brick, as in v1::MeshBricks.
  struct Brick {
    std::vector<float> positions, normals;
    std::vector<std::uint32_t> corners;
  };
  void put(const Place& place, Brick brick);
  void forget(const Place& place);

  std::map<Place, Brick, InOrder> bricks_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

// A mesh, or a part of one, as a server made it.
struct MeshedBricks {
  BrickMesh bricks;
  // The counts are those of the part.
  v1::MeshSummary summary;
};

}  // namespace isofield
