#include "engine/mesh/mesh_part.h"

#include <algorithm>
#include <utility>

#include "base/status_macros.h"
#include "engine/kernels/bindings.h"
#include "engine/mesh/crossing_pass.h"
#include "engine/mesh/element_pass.h"
#include "engine/mesh/mesh_triangles.h"
#include "engine/mesh/part_on_device.h"
#include "engine/mesh/sample_pass.h"
#include "engine/mesh/vertex_pass.h"
#include "engine/session.h"

namespace isofield::engine {
namespace {

using gpu::Buffer;

// Finds the crossings of all slabs before any vertex is placed, since a vertex needs those of neighbouring bricks, too.
absl::StatusOr<Buffer> find_all_crossings(PartOnDevice& part, const std::vector<MeshSlab>& slabs,
                                          const PartElements& elements) {
  ISOFIELD_ASSIGN_OR_RETURN(Buffer crossings,
                            Buffer::create(part.device, std::size_t{12} * elements.quad_count(), Buffer::Use::kDevice));
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    ISOFIELD_RETURN_IF_ERROR(part.check(0.65 + 0.1 * s / slabs.size()));
    ISOFIELD_RETURN_IF_ERROR(find_crossings(part, slabs[s], elements, crossings, [&](std::uint32_t b) {
      return b < part.crossed && part.is(b, kKnowsCrossings) && elements.has_quads(b);
    }));
  }
  return crossings;
}

absl::StatusOr<std::vector<float>> find_fan_normals(PartOnDevice& part, const std::vector<MeshSlab>& slabs,
                                                    const QuadCutter& cutter, const Buffer& centres) {
  const auto has_fans = [&](std::uint32_t b) { return b < part.owned && cutter.has_fans(b); };
  std::vector<float> found(std::size_t{3} * cutter.fans());
  Buffer starts, normals;
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    ISOFIELD_ASSIGN_OR_RETURN(Session session, Session::begin(part.device));
    if (s == 0) {
      ISOFIELD_ASSIGN_OR_RETURN(starts, session.upload(std::span(cutter.fan_starts())));
      ISOFIELD_ASSIGN_OR_RETURN(normals, session.scratch(sizeof(float) * found.size()));
    }
    ISOFIELD_RETURN_IF_ERROR(find_normals(session, part, slabs[s], starts, centres, normals, has_fans));
    if (s + 1 == slabs.size()) ISOFIELD_RETURN_IF_ERROR(session.download(normals, std::span(found)));
    ISOFIELD_RETURN_IF_ERROR(session.run());
  }
  return found;
}

// The vertices at the centres of fans, 3 numbers each.
struct FanCentres {
  std::vector<float> positions, normals;
};

void append(std::vector<float>& to, const std::vector<float>& from, std::uint32_t begin, std::uint32_t end) {
  if (from.empty()) return;
  to.insert(to.end(), from.begin() + 3 * std::size_t{begin}, from.begin() + 3 * std::size_t{end});
}

// Lists the vertices of the part's own bricks: for each brick the vertices of its cells, then the centres of its fans.
void list_own_vertices(const PartOnDevice& part, const PartElements& elements, const PartVertices& vertices,
                       const QuadCutter& cutter, const FanCentres& centres, MeshCells& cells) {
  cells.positions.reserve(3 * std::size_t{elements.starts[part.owned][0]} + centres.positions.size());
  cells.normals.reserve(vertices.normals.size() + centres.normals.size());
  for (std::uint32_t b = 0; b < part.owned; ++b) {
    const MeshStart begin = elements.starts[b], end = elements.starts[b + 1];
    const std::uint32_t fan = cutter.fan_starts()[b][0], fan_end = cutter.fan_starts()[b + 1][0];
    const std::uint32_t count = end[0] - begin[0] + fan_end - fan;
    const std::uint32_t triangles = 2 * (end[1] - begin[1] + fan_end - fan);
    if (count == 0 && triangles == 0) continue;
    const blobtree::Brick& at = part.list.bricks[b];
    cells.bricks.push_back({at.x, at.y, at.z, count, triangles});
    append(cells.positions, vertices.settled, begin[0], end[0]);
    append(cells.positions, centres.positions, fan, fan_end);
    append(cells.normals, vertices.normals, begin[0], end[0]);
    append(cells.normals, centres.normals, fan, fan_end);
  }
}

void list_vertices_beside(const PartOnDevice& part, const PartElements& elements, const PartVertices& vertices,
                          MeshCells& beside) {
  for (std::uint32_t b = part.owned; b < part.placed; ++b) {
    const std::uint32_t count = elements.starts[b + 1][0] - elements.starts[b][0];
    const blobtree::Brick& at = part.list.bricks[b];
    if (count > 0) beside.bricks.push_back({at.x, at.y, at.z, count, 0});
  }
  beside.positions.assign(vertices.settled.begin() + 3 * std::size_t{elements.starts[part.owned][0]},
                          vertices.settled.end());
}

absl::Status make_triangles(PartOnDevice& part, const std::vector<MeshSlab>& slabs, const PartElements& elements,
                            const Buffer& crossings, const PartVertices& vertices, MeshCells& cells) {
  const QuadCutter::Check checked = [&](double fraction) { return part.check(fraction); };
  QuadCutter cutter(part.device, part.kernels, part.constants,
                    {{binding::lattice::kBricks, &part.bricks},
                     {binding::mesh::kSurfaceCases, &part.surface_cases},
                     {binding::mesh::kCells, &elements.cells},
                     {binding::mesh::kNeighbours, &part.neighbours_buffer},
                     {binding::mesh::kStarts, &elements.starts_buffer},
                     {binding::mesh::kQuads, &elements.quads},
                     {binding::mesh::kCrossings, &crossings}},
                    std::span(elements.starts).first(part.owned + 1), checked);
  const bool is_smooth =
      std::none_of(part.kinds.begin(), part.kinds.end(), [](std::uint32_t kind) { return (kind & kMayCrease) != 0; });
  ISOFIELD_RETURN_IF_ERROR(cutter.cut(vertices.positions, vertices.kinds, is_smooth));
  const auto is_unknown = [&](std::uint32_t b) {
    return b < part.owned && !part.is(b, kKnowsCrossings) && cutter.has_fans(b);
  };
  for (std::size_t s = 0; s < slabs.size() && cutter.fans() > 0; ++s) {
    ISOFIELD_RETURN_IF_ERROR(find_crossings(part, slabs[s], elements, crossings, is_unknown));
  }
  FanCentres centres;
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer centre_buffer, cutter.make(cells.corners, centres.positions));
  if (cutter.fans() > 0 && part.request.with_normals) {
    ISOFIELD_ASSIGN_OR_RETURN(centres.normals, find_fan_normals(part, slabs, cutter, centre_buffer));
  }
  ISOFIELD_RETURN_IF_ERROR(part.check(1));
  list_own_vertices(part, elements, vertices, cutter, centres, cells);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<PartMesh> mesh_part(gpu::Device& device, KernelCache& kernels, const ResidentScene& scene,
                                   const MeshRequest& request, PartBricks bricks, const MeshCallbacks& callbacks) {
  PartOnDevice part(device, kernels, scene, request, std::move(bricks), callbacks);
  ISOFIELD_RETURN_IF_ERROR(part.upload());
  ISOFIELD_ASSIGN_OR_RETURN(const PartSamples samples, sample_corners(part));
  ISOFIELD_ASSIGN_OR_RETURN(PartElements elements, connect_cells(part, samples));
  PartMesh mesh;
  mesh.cells.cells = std::uint64_t{part.owned} * blobtree::kCellsPerBrick;
  if (elements.starts[part.placed][0] == 0 && elements.starts[part.owned][1] == 0) return mesh;
  ISOFIELD_RETURN_IF_ERROR(list_elements(part, elements));
  ISOFIELD_ASSIGN_OR_RETURN(const Buffer crossings, find_all_crossings(part, samples.slabs, elements));
  ISOFIELD_ASSIGN_OR_RETURN(PartVertices vertices, place_vertices(part, samples.slabs, elements, crossings));
  ISOFIELD_RETURN_IF_ERROR(settle_vertices(part, samples.slabs, elements, crossings, vertices));
  ISOFIELD_RETURN_IF_ERROR(make_triangles(part, samples.slabs, elements, crossings, vertices, mesh.cells));
  list_vertices_beside(part, elements, vertices, mesh.beside);
  return mesh;
}

}  // namespace isofield::engine
