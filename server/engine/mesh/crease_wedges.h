// A mesh cut open along its creases.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {

// The triangles around a vertex fall into wedges where creases run through it: one wedge away from creases and at a
// crease's end, two along it, more where creases meet. Wedges below the number of vertices bear their vertex's number.
struct CreaseWedges {
  std::vector<std::uint32_t> vertices;  // of each wedge
  std::vector<Triangle> triangles;      // wedge numbers
};

// Creases are rows of edges at which the triangles turn by 25 degrees or more; a single one is none, and cuts nothing.
// Triangles face as face_directions() says.
CreaseWedges crease_wedges(const Mesh& mesh);

}  // namespace isofield::engine
