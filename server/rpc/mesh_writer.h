// Writes a mesh to the client that asked for it.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/support/sync_stream.h>

#include "engine/mesh/mesh_cells.h"
#include "isofield/v1/mesh_service.pb.h"

namespace isofield::rpc {

// For one request and one thread. CANCELLED: the client is gone.
class MeshWriter {
 public:
  // `with_creases`: write_creases() writes some, and so a copy of the mesh is kept.
  MeshWriter(grpc::ServerWriter<v1::MeshResponse>& writer, bool with_creases)
      : writer_(writer), with_creases_(with_creases) {}

  // Writes the next cells of a mesh, in order of place.
  absl::Status write(const engine::MeshCells& cells);
  // Writes a whole mesh.
  absl::Status write(engine::Mesh mesh);
  // After all triangles: writes the normals of creases, where these are wanted.
  absl::Status write_creases();

 private:
  grpc::ServerWriter<v1::MeshResponse>& writer_;
  const bool with_creases_;
  engine::MeshJoiner joiner_;
  engine::Mesh whole_;  // what was written, where creases are wanted
};

}  // namespace isofield::rpc
