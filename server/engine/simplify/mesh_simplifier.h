// Fewer triangles for the same surface, within a stated distance.
#pragma once

#include <absl/status/statusor.h>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"

namespace isofield::engine {

// A mesh with some of the vertices of `mesh`, which is a closed 2-manifold, and their normals; as closed, with as many
// handles. Triangles have an area and face within 60 degrees of what they stand for. Every vertex of `mesh` lies within
// `max_error` of the answer, and every triangle of the answer, looked at in points an edge of `mesh` apart, within it
// of `mesh`: model units, > 0. Vertices on creases (crease_wedges.h) stay, or give way to others on the same crease;
// where creases meet or end they stay. Deterministic. CANCELLED: callbacks.cancelled says so; asked every few
// milliseconds.
absl::StatusOr<Mesh> simplify(const Mesh& mesh, double max_error, const MeshCallbacks& callbacks);

}  // namespace isofield::engine
