// Finds the normals of each side of a crease, since a vertex on a crease needs more than one normal.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh_cells.h"

namespace isofield::engine {

// The triangles around a vertex that creases run through fall into wedges, at least two. These are the wedges of all
// such vertices, in the order of their first corners; corner c of a mesh belongs to triangle c / 3.
struct CreaseNormals {
  std::vector<std::uint32_t> vertices;  // the vertex of each wedge
  std::vector<float> normals;           // 3 a wedge: the mean of its triangles' normals, weighted by their angles there
  // Pairs of a corner and its wedge. A corner that is not listed is in the first wedge of its vertex, or its vertex has
  // no wedges.
  std::vector<std::uint32_t> corners;
};

// Returns the wedges of `mesh`, which must have normals. A crease is a row of edges at which the triangles turn by 25
// degrees or more, and turn as no curved surface with the vertices' normals would. Unlike crease_wedges(), this tells
// creases from coarse triangles of a curved side.
CreaseNormals crease_normals(const Mesh& mesh);

}  // namespace isofield::engine
