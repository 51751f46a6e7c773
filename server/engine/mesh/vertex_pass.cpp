#include "engine/mesh/vertex_pass.h"

#include <algorithm>

#include "base/status_macros.h"
#include "engine/dealing.h"
#include "engine/kernels/bindings.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// Records a dispatch that places the vertices of the slab's bricks, only of those whose kMayCrease bit is `may_crease`.
absl::Status place_slab(Session& session, const PartOnDevice& part, const MeshSlab& slab, const PartElements& elements,
                        const Buffer& crossings, const PartVertices& vertices, bool may_crease) {
  std::vector<std::uint32_t> bricks;
  for (std::uint32_t b = slab.first; b < std::min(slab.first + slab.count, part.placed); ++b) {
    if (elements.has_vertices(b) && part.is(b, kMayCrease) == may_crease) bricks.push_back(b);
  }
  if (bricks.empty()) return absl::OkStatus();
  deal(bricks, 0, bricks.size(), part.device.profile().dispatch_runs);
  const shaders::InRounds& shader = may_crease ? shaders::kMeshPlace : shaders::kMeshPlaceSmooth;
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, part.kernels.get(part.kernels.of(shader)));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const placed, session.lend(std::span(bricks)));
  MeshConstants constants = part.constants;
  constants.first = slab.first;
  return session.commands().dispatch(kernel,
                                     {{binding::lattice::kBricks, &part.bricks},
                                      {binding::mesh::kSurfaceCases, &part.surface_cases},
                                      {binding::mesh::kCells, &elements.cells},
                                      {binding::mesh::kNeighbours, &part.neighbours_buffer},
                                      {binding::mesh::kStarts, &elements.starts_buffer},
                                      {binding::mesh::kVertices, &elements.vertices},
                                      {binding::mesh::kCrossings, &crossings},
                                      {binding::mesh::kPositions, &vertices.positions},
                                      {binding::mesh_place::kKinds, &vertices.kinds},
                                      {binding::mesh_place::kSamples, &slab.samples},
                                      {binding::mesh_place::kPlaced, placed}},
                                     constants, static_cast<std::uint32_t>(bricks.size()));
}

absl::Status settle_on_creases(Session& session, PartOnDevice& part, const MeshSlab& slab, const PartElements& elements,
                               const Buffer& crossings, const PartVertices& vertices) {
  const auto has_creases = [&](std::uint32_t b) { return b < part.placed && part.is(b, kHasCreases); };
  return part.tapes.run_each(session, part.kernels.of(shaders::kMeshCreases), part.constants, slab.first, slab.count,
                             has_creases,
                             {{binding::lattice::kBricks, &part.bricks},
                              {binding::mesh::kCells, &elements.cells},
                              {binding::mesh::kNeighbours, &part.neighbours_buffer},
                              {binding::mesh::kStarts, &elements.starts_buffer},
                              {binding::mesh::kVertices, &elements.vertices},
                              {binding::mesh::kCrossings, &crossings},
                              {binding::mesh::kPositions, &vertices.positions}});
}

absl::Status settle_on_surface(Session& session, PartOnDevice& part, const MeshSlab& slab, const PartElements& elements,
                               const PartVertices& vertices) {
  const auto is_placed = [&](std::uint32_t b) { return b < part.placed && elements.has_vertices(b); };
  return part.tapes.run_each(session, part.kernels.of(shaders::kMeshVertices), part.constants, slab.first, slab.count,
                             is_placed,
                             {{binding::lattice::kBricks, &part.bricks},
                              {binding::mesh::kCells, &elements.cells},
                              {binding::mesh_vertices::kSurfaceCases, &part.surface_cases},
                              {binding::mesh::kStarts, &elements.starts_buffer},
                              {binding::mesh::kVertices, &elements.vertices},
                              {binding::mesh::kPositions, &vertices.positions}});
}

}  // namespace

absl::StatusOr<PartVertices> place_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs,
                                            const PartElements& elements, const Buffer& crossings) {
  PartVertices vertices;
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
  ISOFIELD_ASSIGN_OR_RETURN(vertices.positions, session.scratch(std::size_t{12} * elements.vertex_count()));
  ISOFIELD_ASSIGN_OR_RETURN(vertices.kinds, session.upload(std::span(part.kinds)));
  for (const MeshSlab& slab : slabs) {
    for (const bool may_crease : {true, false}) {
      ISOFIELD_RETURN_IF_ERROR(place_slab(session, part, slab, elements, crossings, vertices, may_crease));
    }
  }
  ISOFIELD_RETURN_IF_ERROR(session.download(vertices.kinds, std::span(part.kinds)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  return vertices;
}

absl::Status settle_vertices(PartOnDevice& part, std::span<const MeshSlab> slabs, const PartElements& elements,
                             const Buffer& crossings, PartVertices& vertices) {
  vertices.settled.resize(std::size_t{3} * elements.starts[part.placed][0]);
  if (part.request.with_normals) vertices.normals.resize(std::size_t{3} * elements.starts[part.owned][0]);
  const auto is_own = [&](std::uint32_t b) { return b < part.owned && elements.has_vertices(b); };
  Buffer normals;
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    ISOFIELD_RETURN_IF_ERROR(part.check(0.75 + 0.2 * s / slabs.size()));
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
    ISOFIELD_RETURN_IF_ERROR(settle_on_creases(session, part, slabs[s], elements, crossings, vertices));
    session.commands().barrier();
    ISOFIELD_RETURN_IF_ERROR(settle_on_surface(session, part, slabs[s], elements, vertices));
    if (part.request.with_normals) {
      if (s == 0) {
        ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(sizeof(float) * vertices.normals.size()));
      }
      session.commands().barrier();
      ISOFIELD_RETURN_IF_ERROR(
          find_normals(session, part, slabs[s], elements.starts_buffer, vertices.positions, normals, is_own));
    }
    if (s + 1 == slabs.size()) {
      ISOFIELD_RETURN_IF_ERROR(session.download(vertices.positions, std::span(vertices.settled)));
      ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(vertices.normals)));
    }
    ISOFIELD_RETURN_IF_ERROR(session.run());
  }
  return absl::OkStatus();
}

absl::Status find_normals(Session& session, PartOnDevice& part, const MeshSlab& slab, const Buffer& starts,
                          const Buffer& positions, const Buffer& normals,
                          const std::function<bool(std::uint32_t brick)>& is_wanted) {
  return part.tapes.run_each(session, part.kernels.of(shaders::kMeshNormals), part.constants, slab.first, slab.count,
                             is_wanted,
                             {{binding::lattice::kBricks, &part.bricks},
                              {binding::mesh_normals::kStarts, &starts},
                              {binding::mesh_normals::kPositions, &positions},
                              {binding::mesh_normals::kNormals, &normals}});
}

}  // namespace isofield::engine
