// Cuts a mesh open along its creases, so that the sides of a crease share no vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {

// Creases divide the triangles around a vertex into wedges: one wedge away from creases and at a crease's end, two
// along a crease, more where creases meet. Wedges with numbers below the number of vertices have the number of their
// vertex.
struct CreaseWedges {
  std::vector<std::uint32_t> vertices;  // the vertex of each wedge
  std::vector<Triangle> triangles;      // the mesh's triangles, by wedge numbers
};

// Creases are rows of edges at which the triangles turn by 25 degrees or more; a single such edge cuts nothing. The
// triangles' normals are those of face_directions().
CreaseWedges crease_wedges(const Mesh& mesh);

}  // namespace isofield::engine
