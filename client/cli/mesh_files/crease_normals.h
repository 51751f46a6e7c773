#pragma once

#include <cstdint>
#include <vector>

#include "isofield/client.h"

namespace isofield {

// The normals of a mesh with one for each side where creases pass through a vertex.
struct CreaseNormals {
  // [n + k, 3]: those of the n vertices, on creases of their first sides, then those of further sides.
  std::vector<float> normals;
  std::vector<std::uint32_t> vertices;  // [k]: of the further ones
  std::vector<std::uint32_t> corners;   // [m, 3]: which normal each corner of a triangle has
};

// Tells them by Mesh::creases. `mesh` has normals.
CreaseNormals crease_normals(const Mesh& mesh);

// The mesh with a vertex for each of these normals; itself where it has no creases.
Mesh split_at_creases(Mesh mesh);

}  // namespace isofield
