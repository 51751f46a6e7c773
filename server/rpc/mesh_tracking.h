// Serves one TrackMesh call: it sends the mesh of a scene, and after each edit or refresh the bricks that have changed.
#pragma once

#include <absl/status/status.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <optional>
#include <string>

#include "engine/engine.h"
#include "engine/mesh/mesh_tracker.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "rpc/admission.h"
#include "rpc/limits.h"
#include "rpc/mesh_messages.h"
#include "scenes/scene_editor.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// The stream of a TrackMesh call, whose requests are read as the bytes of TrackMeshRequests.
using TrackMeshStream = grpc::ServerReaderWriter<v1::TrackMeshResponse, grpc::ByteBuffer>;

// Serves one call, on one thread. Its updates count as work but are never refused, since limits.max_tracked_meshes
// bounds the number of streams.
class MeshTracking {
 public:
  MeshTracking(const scenes::SceneSource& scenes, scenes::SceneEditor& editor, engine::Engine& engine,
               const Limits& limits, Admission& admission, grpc::ServerContext& context, TrackMeshStream& stream)
      : scenes_(scenes),
        editor_(editor),
        engine_(engine),
        limits_(limits),
        admission_(admission),
        context_(context),
        stream_(stream) {}

  // Answers requests until the client ends the stream. The first error ends it, too.
  absl::Status run();

 private:
  absl::Status begin(const v1::MeshRequest& request);
  absl::Status follow(const v1::TrackMeshRequest& request);
  absl::Status answer(const scenes::LeasedScene& leased);
  absl::Status write(v1::MeshUpdate update);

  const scenes::SceneSource& scenes_;
  scenes::SceneEditor& editor_;
  engine::Engine& engine_;
  const Limits& limits_;
  Admission& admission_;
  grpc::ServerContext& context_;
  TrackMeshStream& stream_;

  v1::SceneRef scene_;
  engine::MeshRequest request_;
  std::optional<engine::MeshTracker> tracker_;
  std::uint64_t version_ = 0;
};

}  // namespace isofield::rpc
