#include "engine/mesh/crossing_pass.h"

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/session.h"

namespace isofield::engine {

absl::Status find_crossings(PartOnDevice& part, const MeshSlab& slab, const PartElements& elements,
                            const gpu::Buffer& crossings, const std::function<bool(std::uint32_t brick)>& is_wanted) {
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
  ISOFIELD_RETURN_IF_ERROR(part.tapes.run_each(session, part.kernels.of(shaders::kMeshCrossings), part.constants,
                                               slab.first, slab.count, is_wanted,
                                               {{binding::lattice::kBricks, &part.bricks},
                                                {binding::mesh_crossings::kSamples, &slab.samples},
                                                {binding::mesh::kStarts, &elements.starts_buffer},
                                                {binding::mesh::kQuads, &elements.quads},
                                                {binding::mesh::kCrossings, &crossings}}));
  return session.run();
}

}  // namespace isofield::engine
