#include "rpc/mesh_messages.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

#include "base/status_macros.h"
#include "blobtree/cull/nearest_leaf.h"
#include "engine/mesh/cell_size.h"
#include "engine/mesh/mesh_lattice.h"
#include "rpc/answer_limit.h"
#include "rpc/geometry_arguments.h"
#include "rpc/tensor.h"

namespace isofield::rpc {
namespace {

constexpr std::uint32_t kMaxResolution = 1u << 20;

// The limits of a mesh's tolerance, in cells. A smaller one would gain nothing in float32.
constexpr double kLeastTolerance = 1e-5, kMostTolerance = 0.1;

// Fills in the cell size of `r`, whose other fields are read.
absl::Status read_cell_size(const v1::MeshRequest& request, const engine::ResidentScene& scene,
                            const engine::Mesher& mesher, const std::function<bool()>& cancelled,
                            engine::MeshRequest& r) {
  switch (request.cells_case()) {
    case v1::MeshRequest::kCellSize: {
      ISOFIELD_ASSIGN_OR_RETURN(r.cell_size, read_length("cell_size", request.cell_size()));
      return absl::OkStatus();
    }
    case v1::MeshRequest::kResolution: {
      if (request.resolution() < 1 || request.resolution() > kMaxResolution) {
        return absl::InvalidArgumentError(
            absl::StrCat("resolution = ", request.resolution(), ": expected a count within [1, ", kMaxResolution, "]"));
      }
      r.resolution = request.resolution();
      const blobtree::Box box = r.bounds.value_or(scene.tape().support);
      const blobtree::dvec3 edges = box.max - box.min;
      r.cell_size = box.empty() ? 1.0 : std::max({edges.x, edges.y, edges.z}) / request.resolution();
      return absl::OkStatus();
    }
    default: {
      ISOFIELD_ASSIGN_OR_RETURN(r.cell_size, mesher.automatic_cell_size(scene, r, cancelled));
      return absl::OkStatus();
    }
  }
}

absl::StatusOr<double> read_tolerance(const v1::MeshRequest& request, double otherwise) {
  if (!request.has_tolerance()) return otherwise;
  if (!(request.tolerance() >= kLeastTolerance && request.tolerance() <= kMostTolerance)) {
    return absl::InvalidArgumentError(absl::StrCat("tolerance = ", request.tolerance(), ": expected cells within [",
                                                   kLeastTolerance, ", ", kMostTolerance, "], or none for ",
                                                   otherwise));
  }
  return request.tolerance();
}

void fill_slivers(const engine::ShellCounts& shells, const scenes::LeasedScene& leased, v1::MeshSummary& summary) {
  if (shells.sliver_bodies + shells.sliver_voids == 0) return;
  v1::Slivers& slivers = *summary.mutable_slivers();
  slivers.set_bodies(shells.sliver_bodies);
  slivers.set_voids(shells.sliver_voids);
  set_vector({shells.sliver[0], shells.sliver[1], shells.sliver[2]}, *slivers.mutable_position());
  const blobtree::Tape& tape = leased.scene->tape();
  const std::uint32_t leaf = blobtree::nearest_leaves(tape, shells.sliver).front();
  if (leaf != blobtree::kNoLeaf) slivers.set_node(scenes::node_name(*leased.message, tape.leaves[leaf].node));
}

}  // namespace

absl::StatusOr<engine::MeshRequest> read_mesh_request(const v1::MeshRequest& request,
                                                      const engine::ResidentScene& scene, const engine::Mesher& mesher,
                                                      const Limits& limits, const std::function<bool()>& cancelled) {
  const blobtree::Tape& tape = scene.tape();
  engine::MeshRequest r;
  ISOFIELD_ASSIGN_OR_RETURN(r.bounds, read_bounds(request.bounds_min(), request.bounds_max()));
  ISOFIELD_ASSIGN_OR_RETURN(r.iso, read_iso(request, tape.law));
  ISOFIELD_RETURN_IF_ERROR(check_bounded(tape, r.bounds, r.iso));
  ISOFIELD_ASSIGN_OR_RETURN(r.tolerance, read_tolerance(request, r.tolerance));
  r.with_normals = !request.omit_normals();
  r.max_cells = limits.max_mesh_cells;
  ISOFIELD_RETURN_IF_ERROR(read_cell_size(request, scene, mesher, cancelled, r));
  return r;
}

std::uint64_t estimated_cells(const blobtree::Tape& tape, const engine::MeshRequest& request) {
  const absl::StatusOr<blobtree::Lattice> lattice = engine::mesh_lattice(tape, request);
  if (!lattice.ok()) return 0;  // the mesher refuses the request
  const auto [x, y, z] = lattice->cells;
  std::uint64_t cells = 2 * (std::uint64_t{x} * y + std::uint64_t{y} * z + std::uint64_t{z} * x);
  if (request.part) {
    std::uint64_t part = blobtree::kCellsPerBrick;
    for (int i = 0; i < 3; ++i) {
      const std::uint64_t bricks = (lattice->cells[i] + blobtree::kBrickCells - 1) / blobtree::kBrickCells;
      part *= std::min<std::uint64_t>(request.part->high[i], bricks) -
              std::min<std::uint64_t>(request.part->low[i], bricks);
    }
    cells = std::min(cells, part);
  }
  return std::min(cells, request.max_cells);
}

absl::StatusOr<std::optional<double>> read_simplification_error(const v1::MeshRequest& request) {
  if (!request.has_simplification_error()) return std::nullopt;
  return read_length("simplification_error", request.simplification_error());
}

engine::ShellFilter read_shell_filter(const v1::MeshRequest& request) {
  return {.largest_body = request.largest_body(), .fill_voids = request.fill_voids()};
}

absl::StatusOr<bool> read_crease_normals(const v1::MeshRequest& request) {
  if (request.crease_normals() && request.omit_normals()) {
    return absl::InvalidArgumentError("crease_normals = true: expected false where omit_normals leaves normals out");
  }
  return request.crease_normals();
}

absl::Status check_as_made(const v1::MeshRequest& request) {
  const auto refuse = [](const std::string& field, const char* who) {
    return absl::InvalidArgumentError(
        absl::StrCat(field, ": expected none, since bricks are the same whatever part they come with; ", who));
  };
  if (request.has_simplification_error()) {
    return refuse(absl::StrCat("simplification_error = ", request.simplification_error()), "Mesh and Measure simplify");
  }
  if (request.largest_body()) return refuse("largest_body = true", "Mesh and Measure leave bodies out");
  if (request.fill_voids()) return refuse("fill_voids = true", "Mesh and Measure leave voids out");
  if (request.crease_normals()) return refuse("crease_normals = true", "Mesh tells creases, which need all of a mesh");
  return absl::OkStatus();
}

std::size_t fill_bricks(const engine::MeshCells& cells, std::size_t first, std::size_t& vertex, std::size_t& triangle,
                        v1::MeshBricks& message) {
  std::vector<std::uint32_t> rows;
  std::size_t at = first, vertices = 0, triangles = 0;
  const std::size_t vertex_bytes = cells.normals.empty() ? 12 : 24;
  // The last brick may exceed kPartBytes, which does no harm: a brick is far smaller than a part.
  while (at < cells.bricks.size() && rows.size() * 4 + vertices * vertex_bytes + triangles * 12 < kPartBytes) {
    const engine::MeshBrick& b = cells.bricks[at++];
    rows.insert(rows.end(), {b.x, b.y, b.z, b.vertices, b.triangles});
    vertices += b.vertices;
    triangles += b.triangles;
  }
  set_rows(std::span<const std::uint32_t>(rows), 5, *message.mutable_bricks());
  set_rows(std::span(cells.positions).subspan(3 * vertex, 3 * vertices), 3, *message.mutable_positions());
  if (!cells.normals.empty()) {
    set_rows(std::span(cells.normals).subspan(3 * vertex, 3 * vertices), 3, *message.mutable_normals());
  }
  set_rows(std::span(cells.corners).subspan(3 * triangle, 3 * triangles), 3, *message.mutable_corners());
  vertex += vertices;
  triangle += triangles;
  return at;
}

void MeshTotals::add(const engine::MeshCells& part) {
  vertices += part.positions.size() / 3;
  triangles += part.corners.size() / 3;
  cells += part.cells;
}

void MeshTotals::add(const engine::Mesh& whole) {
  vertices += whole.positions.size() / 3;
  triangles += whole.triangles.size() / 3;
  cells += whole.cells;
}

void fill_summary(const MeshTotals& totals, const engine::MeshRequest& request, const scenes::LeasedScene& leased,
                  v1::MeshSummary& summary) {
  const blobtree::Tape& tape = leased.scene->tape();
  summary.set_vertices(totals.vertices);
  summary.set_triangles(totals.triangles);
  summary.set_cell_size(request.cell_size);
  summary.set_cells(totals.cells);
  summary.set_scene_version(leased.version);
  summary.set_unit(leased.message->unit());
  if (totals.shells) {
    summary.set_bodies(totals.shells->bodies);
    summary.set_voids(totals.shells->voids);
    fill_slivers(*totals.shells, leased, summary);
  }
  summary.set_dropped_bodies(totals.dropped.bodies);
  summary.set_dropped_voids(totals.dropped.voids);
  if (const auto thin = engine::too_thin(tape, request)) {
    summary.mutable_too_thin()->set_node(scenes::node_name(*leased.message, thin->node));
    summary.mutable_too_thin()->set_thickness(thin->thickness);
    summary.mutable_too_thin()->set_cell_size(thin->cell_size);
    summary.mutable_too_thin()->set_primitives(thin->primitives);
  }
  if (const auto lattice = engine::mesh_lattice(tape, request); lattice.ok() && !tape.support.empty()) {
    set_vector(lattice->origin, *summary.mutable_lattice_origin());
    for (const std::uint32_t cells : lattice->cells) {
      summary.add_lattice_bricks((cells + blobtree::kBrickCells - 1) / blobtree::kBrickCells);
    }
  }
  summary.set_seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - totals.start).count());
}

}  // namespace isofield::rpc
