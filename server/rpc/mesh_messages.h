// Mesh requests as they are sent, and meshes as they are answered.
#pragma once

#include <absl/status/statusor.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "engine/mesh/mesh_cells.h"
#include "engine/mesh/mesh_request.h"
#include "engine/mesh/mesh_shells.h"
#include "engine/mesh/mesher.h"
#include "isofield/v1/mesh_service.pb.h"
#include "rpc/limits.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// Chooses the cell size where none is stated.
absl::StatusOr<engine::MeshRequest> read_mesh_request(const v1::MeshRequest& request,
                                                      const engine::ResidentScene& scene, const engine::Mesher& mesher,
                                                      const Limits& limits, const std::function<bool()>& cancelled);

// About how many cells the surface crosses, by which admission estimates the work: as many as cover the faces of the
// lattice, within the part and the limit that the request states.
std::uint64_t estimated_cells(const blobtree::Tape& tape, const engine::MeshRequest& request);

// Model units; nothing: none is asked for.
absl::StatusOr<std::optional<double>> read_simplification_error(const v1::MeshRequest& request);
engine::ShellFilter read_shell_filter(const v1::MeshRequest& request);
// Whether the answer has MeshCreases. INVALID_ARGUMENT: it is to have no normals.
absl::StatusOr<bool> read_crease_normals(const v1::MeshRequest& request);
// Bricks are the same whatever part they come with, and so as they are made: INVALID_ARGUMENT where a mesh that is
// simplified, lacks some of its bodies or voids, or has normals of creases, is asked for.
absl::Status check_as_made(const v1::MeshRequest& request);

// Bricks `first` and on: as many as a message holds. `vertex` and `triangle` are those before them, and move on.
std::size_t fill_bricks(const engine::MeshCells& cells, std::size_t first, std::size_t& vertex, std::size_t& triangle,
                        v1::MeshBricks& message);

// Calls write(MeshBricks) with `cells` in pieces that messages hold, none where there is nothing. Ends with the first
// error of write().
template <class Write>
absl::Status write_bricks(const engine::MeshCells& cells, const Write& write) {
  std::size_t vertex = 0, triangle = 0;
  for (std::size_t at = 0; at < cells.bricks.size();) {
    v1::MeshBricks message;
    at = fill_bricks(cells, at, vertex, triangle, message);
    if (absl::Status s = write(std::move(message)); !s.ok()) return s;
  }
  return absl::OkStatus();
}

// What a mesh is summed up from, while it is made.
struct MeshTotals {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t vertices = 0, triangles = 0, cells = 0;
  std::optional<engine::ShellCounts> shells;  // of what is sent, where that is known
  engine::ShellCounts dropped;

  void add(const engine::MeshCells& part);
  void add(const engine::Mesh& whole);
};
void fill_summary(const MeshTotals& totals, const engine::MeshRequest& request, const scenes::LeasedScene& leased,
                  v1::MeshSummary& summary);

}  // namespace isofield::rpc
