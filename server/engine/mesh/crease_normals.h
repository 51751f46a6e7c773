// Normals for the sides of creases, where one a vertex says too little.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh_cells.h"

namespace isofield::engine {

// The triangles around a vertex that creases run through fall into wedges, at least two. These are the wedges of all
// such vertices, in the order of their first corners; corner c of a mesh belongs to triangle c / 3.
struct CreaseNormals {
  std::vector<std::uint32_t> vertices;  // of each wedge
  std::vector<float> normals;           // 3 a wedge: the mean of its triangles' directions by their angles there
  // 2 numbers each: a corner, and its wedge. Corners that are not named are in the first wedge of their vertex, or
  // their vertex has none.
  std::vector<std::uint32_t> corners;
};

// Creases are rows of edges at which the triangles turn by 25 degrees or more, as no curved surface with the vertices'
// normals would; unlike crease_wedges() this tells creases from coarse triangles of a curved side. `mesh` has normals.
CreaseNormals crease_normals(const Mesh& mesh);

}  // namespace isofield::engine
