#pragma once

#include <cstdint>
#include <vector>

#include "isofield/client.h"

namespace isofield {

// The normals of a mesh in which a vertex on a crease has a normal for each side of the crease, as GLB and OBJ files
// need them.
struct CreaseNormals {
  // [n + k, 3]: one normal for each of the n vertices, on creases that of the first side; then the k of further sides.
  std::vector<float> normals;
  std::vector<std::uint32_t> vertices;  // [k]: the vertex of each further normal
  std::vector<std::uint32_t> corners;   // [m, 3]: the number of the normal at each corner of each triangle
};

// Computes these normals from Mesh::creases. The mesh must have normals.
CreaseNormals crease_normals(const Mesh& mesh);

// Returns the mesh with a vertex for each of these normals. A mesh without creases is returned as it is.
Mesh split_at_creases(Mesh mesh);

}  // namespace isofield
