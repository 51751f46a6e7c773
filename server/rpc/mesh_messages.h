// Reads mesh requests from their messages, and fills the messages of the answers: bricks and summaries.
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

// Reads a request, and chooses the cell size if none is stated. INVALID_ARGUMENT: a field is refused. Other errors are
// those of Mesher::automatic_cell_size.
absl::StatusOr<engine::MeshRequest> read_mesh_request(const v1::MeshRequest& request,
                                                      const engine::ResidentScene& scene, const engine::Mesher& mesher,
                                                      const Limits& limits, const std::function<bool()>& cancelled);

// Estimates how many cells the surface crosses, which admission takes as the size of the work: as many cells as cover
// the faces of the lattice, but at most those of request.part and at most request.max_cells.
std::uint64_t estimated_cells(const blobtree::Tape& tape, const engine::MeshRequest& request);

// Returns the simplification error in model units, or nothing if no simplification is asked for. INVALID_ARGUMENT: it
// is no length above 0.
absl::StatusOr<std::optional<double>> read_simplification_error(const v1::MeshRequest& request);
engine::ShellFilter read_shell_filter(const v1::MeshRequest& request);
// Returns whether the client wants MeshCreases. INVALID_ARGUMENT: it wants them, but no normals.
absl::StatusOr<bool> read_crease_normals(const v1::MeshRequest& request);
// Checks a request for bricks. Bricks are sent as they are made, so that they are the same whatever part they come
// with. INVALID_ARGUMENT: the request asks for a mesh that is simplified, lacks some of its bodies or voids, or has
// normals of creases.
absl::Status check_as_made(const v1::MeshRequest& request);

// Fills a message with as many bricks as it can hold, from brick `first` on, and returns the first brick after them.
// `vertex` and `triangle` are the numbers of vertices and triangles before brick `first`, and are moved on.
std::size_t fill_bricks(const engine::MeshCells& cells, std::size_t first, std::size_t& vertex, std::size_t& triangle,
                        v1::MeshBricks& message);

// Cuts `cells` into messages and calls write(MeshBricks) for each; without any bricks there is no message. Ends with
// the first error of write().
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

// Collects the numbers of a mesh's summary while the mesh is made.
struct MeshTotals {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t vertices = 0, triangles = 0, cells = 0;
  std::optional<engine::ShellCounts> shells;  // those of the mesh that is sent, if they are known
  engine::ShellCounts dropped;                // those that the request has left out

  void add(const engine::MeshCells& part);
  void add(const engine::Mesh& whole);
};
void fill_summary(const MeshTotals& totals, const engine::MeshRequest& request, const scenes::LeasedScene& leased,
                  v1::MeshSummary& summary);

}  // namespace isofield::rpc
