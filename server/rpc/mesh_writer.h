// Writes a mesh to the client that asked for it, as a series of messages.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/sync_stream.h>

#include "engine/mesh/mesh_cells.h"
#include "isofield/v1/mesh_service.pb.h"

namespace isofield::rpc {

// Serves one request, on one thread. All functions fail with CANCELLED if the client is gone.
class MeshWriter {
 public:
  // If `with_creases` is set, a copy of the mesh is kept, from which write_creases() computes the normals.
  MeshWriter(grpc::ServerWriter<v1::MeshResponse>& writer, bool with_creases)
      : writer_(writer), with_creases_(with_creases) {}

  // Writes the next cells of a mesh. Cells must come in order of place.
  absl::Status write(const engine::MeshCells& cells);
  // Writes a whole mesh.
  absl::Status write(engine::Mesh mesh);
  // Writes the normals of creases if the client wants them. All triangles must have been written.
  absl::Status write_creases();

 private:
  grpc::ServerWriter<v1::MeshResponse>& writer_;
  const bool with_creases_;
  engine::MeshJoiner joiner_;
  engine::Mesh whole_;  // what has been written, if creases are wanted
};

}  // namespace isofield::rpc
