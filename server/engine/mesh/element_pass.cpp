#include "engine/mesh/element_pass.h"

#include <absl/strings/str_cat.h>

#include <span>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/mesh/mesh_lattice.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

absl::Status sum_up(const PartOnDevice& part, std::span<const MeshStart> counts, std::vector<MeshStart>& starts) {
  starts.assign(1, {0, 0});
  starts.reserve(counts.size() + 1);
  std::uint64_t vertices = 0, quads = 0;
  for (const MeshStart& c : counts) {
    vertices += c[0];
    quads += c[1];
    starts.push_back({static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(quads)});
  }
  return check_elements(part.request, vertices, quads, part.device.description().max_buffer_bytes);
}

}  // namespace

absl::Status check_elements(const MeshRequest& request, std::uint64_t vertices, std::uint64_t quads,
                            std::uint64_t max_buffer_bytes) {
  // The largest buffers take 12 bytes a vertex, and 16 a quad (QuadCutter).
  const std::uint64_t most_vertices = max_buffer_bytes / 12, most_quads = max_buffer_bytes / 16;
  if (vertices <= most_vertices && quads <= most_quads) return absl::OkStatus();
  return absl::ResourceExhaustedError(absl::StrCat(stated_size(request), " makes ", vertices, " vertices and ", quads,
                                                   " quads at once; this device holds ", most_vertices, " and ",
                                                   most_quads, "; ask for larger cells, or a part by its bounds"));
}

absl::StatusOr<PartElements> connect_cells(PartOnDevice& part, const PartSamples& samples) {
  ISOFIELD_RETURN_IF_ERROR(part.check(0.6));
  const std::uint32_t total = part.total();
  std::vector<MeshStart> counts(total);
  PartElements elements;
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, part.kernels.get(shaders::kMeshConnect));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
  ISOFIELD_ASSIGN_OR_RETURN(elements.cells, session.scratch(std::size_t{4} * blobtree::kCellsPerBrick * total));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer* const count_buffer, session.lend_scratch(sizeof(MeshStart) * total));
  MeshConstants constants = part.constants;
  constants.count = total;
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel,
                                                       {{binding::lattice::kBricks, &part.bricks},
                                                        {binding::mesh::kSurfaceCases, &part.surface_cases},
                                                        {binding::mesh_connect::kCases, &samples.cases},
                                                        {binding::mesh::kNeighbours, &part.neighbours_buffer},
                                                        {binding::mesh_connect::kCells, &elements.cells},
                                                        {binding::mesh_connect::kCounts, count_buffer}},
                                                       constants, mesh_groups(total)));
  ISOFIELD_RETURN_IF_ERROR(session.download(*count_buffer, std::span(counts)));
  ISOFIELD_RETURN_IF_ERROR(session.run());
  ISOFIELD_RETURN_IF_ERROR(sum_up(part, counts, elements.starts));
  return elements;
}

absl::Status list_elements(PartOnDevice& part, PartElements& elements) {
  ISOFIELD_RETURN_IF_ERROR(part.check(0.65));
  ISOFIELD_ASSIGN_OR_RETURN(const gpu::SharedPipeline kernel, part.kernels.get(shaders::kMeshList));
  ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
  ISOFIELD_ASSIGN_OR_RETURN(elements.starts_buffer, session.upload(std::span(elements.starts)));
  ISOFIELD_ASSIGN_OR_RETURN(elements.vertices, session.scratch(std::size_t{4} * elements.vertex_count()));
  ISOFIELD_ASSIGN_OR_RETURN(elements.quads, session.scratch(std::size_t{8} * elements.quad_count()));
  MeshConstants constants = part.constants;
  constants.count = part.total();
  ISOFIELD_RETURN_IF_ERROR(session.commands().dispatch(kernel,
                                                       {{binding::lattice::kBricks, &part.bricks},
                                                        {binding::mesh::kSurfaceCases, &part.surface_cases},
                                                        {binding::mesh::kCells, &elements.cells},
                                                        {binding::mesh_list::kStarts, &elements.starts_buffer},
                                                        {binding::mesh_list::kVertices, &elements.vertices},
                                                        {binding::mesh::kQuads, &elements.quads}},
                                                       constants, mesh_groups(constants.count)));
  return session.run();
}

}  // namespace isofield::engine
