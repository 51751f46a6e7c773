// The passes of the mesher that put a part's vertices on the surface and find their normals (shaders/mesh_place.comp,
// mesh_creases.comp, mesh_vertices.comp, mesh_normals.comp).
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mesh/element_pass.h"
#include "engine/mesh/part_on_device.h"
#include "engine/mesh/sample_pass.h"
#include "engine/session.h"
#include "gpu/buffer.h"

namespace isofield::engine {

struct PartVertices {
  gpu::Buffer positions;       // for the vertices of all bricks
  gpu::Buffer kinds;           // BrickKind bits of each brick, kHasCreases included
  std::vector<float> settled;  // the final positions in the `placed` bricks, 3 a vertex
  std::vector<float> normals;  // in the part's own bricks, 3 a vertex, if the request asks for normals
};

// Puts each vertex at the place where it starts, and notes in part.kinds which bricks have creases.
absl::StatusOr<PartVertices> place_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs,
                                            const PartElements& elements, const gpu::Buffer& crossings);
// Moves the vertices onto the surface: first those on creases, onto all sides of the crease; then all that are not on
// the surface yet.
absl::Status settle_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs, const PartElements& elements,
                             const gpu::Buffer& crossings, PartVertices& vertices);

// Records a dispatch that finds the normals at the positions of the slab's wanted bricks; `starts` says where the
// positions of each brick begin.
absl::Status find_normals(Session& session, PartOnDevice& part, const MeshSlab& slab, const gpu::Buffer& starts,
                          const gpu::Buffer& positions, const gpu::Buffer& normals,
                          const std::function<bool(std::uint32_t brick)>& is_wanted);

}  // namespace isofield::engine
