#pragma once

#include <cstdint>
#include <vector>

#include "isofield/client.h"

namespace isofield {

// The normals of a mesh with one for each side where creases pass through a vertex.
struct CreaseNormals {
  // [n + k, 3]: the n vertices' own, then those of further sides. A vertex on a crease has for each side the mean of
  // that side's triangles by their angles there; other vertices keep what they had.
  std::vector<float> normals;
  std::vector<std::uint32_t> vertices;  // [k]: of the further ones
  std::vector<std::uint32_t> corners;   // [m, 3]: which normal each corner of a triangle has
};

// Creases are edges at which triangles turn by 25 degrees or more, as no curved surface with such normals would.
// `mesh` has normals.
CreaseNormals crease_normals(const Mesh& mesh);

// The mesh with a vertex for each of these normals; itself where it has no creases or no normals.
Mesh split_at_creases(Mesh mesh);

}  // namespace isofield
