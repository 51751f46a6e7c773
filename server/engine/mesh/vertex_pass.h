// The mesher's passes that put a part's vertices on the surface, and find their normals (shaders/mesh_place.comp,
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
  gpu::Buffer positions;       // of all bricks
  gpu::Buffer kinds;           // of bricks, with kHasCreases
  std::vector<float> settled;  // positions of bricks that are placed, 3 a vertex
  std::vector<float> normals;  // of the part's own bricks, where the request asks for normals
};

// Where each vertex starts; notes in part.kinds which bricks have creases.
absl::StatusOr<PartVertices> place_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs,
                                            const PartElements& elements, const gpu::Buffer& crossings);
// Moves them onto the surface: those on creases along all sides of these, then all that are not there yet.
absl::Status settle_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs, const PartElements& elements,
                             const gpu::Buffer& crossings, PartVertices& vertices);

// Records the normals at the positions of the slab's wanted bricks, which start where `starts` says.
absl::Status find_normals(Session& session, PartOnDevice& part, const MeshSlab& slab, const gpu::Buffer& starts,
                          const gpu::Buffer& positions, const gpu::Buffer& normals,
                          const std::function<bool(std::uint32_t brick)>& is_wanted);

}  // namespace isofield::engine
