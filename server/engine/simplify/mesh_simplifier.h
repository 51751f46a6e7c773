// Simplifies a mesh: makes fewer triangles for the same surface, within a stated distance of it.
#pragma once

#include <absl/status/statusor.h>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// Returns a mesh with some of the vertices of `mesh` and their normals. `mesh` must be a closed 2-manifold; the result
// is one, too, and has as many handles. Its triangles have an area, and each faces within 60 degrees of the triangles
// that it replaces. `max_error` (model units, > 0) bounds the distance of every vertex of `mesh` from the result, and
// that of the result from `mesh`, which is checked at points that are an edge of `mesh` apart. Vertices on creases
// (crease_wedges.h) stay or give way to others on the same crease; vertices where creases meet or end stay.
// Deterministic. CANCELLED: callbacks.cancelled says so; it is called every few milliseconds.
absl::StatusOr<Mesh> simplify(const Mesh& mesh, double max_error, const MeshCallbacks& callbacks);

}  // namespace isofield::engine
