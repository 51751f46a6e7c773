// MeshService of the contract.
#pragma once

#include <atomic>

#include "engine/engine.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "rpc/limits.h"
#include "rpc/mesh_tracking.h"
#include "scenes/scene_editor.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

class MeshService final : public v1::MeshService::Service {
 public:
  MeshService(const scenes::SceneSource& scenes, scenes::SceneEditor& editor, engine::Engine& engine,
              const Limits& limits);

  grpc::Status Mesh(grpc::ServerContext*, const v1::MeshRequest*, grpc::ServerWriter<v1::MeshResponse>*) override;
  grpc::Status GetMeshBricks(grpc::ServerContext*, const v1::MeshBricksRequest*,
                             grpc::ServerWriter<v1::MeshBricksResponse>*) override;
  grpc::Status Measure(grpc::ServerContext*, const v1::MeshRequest*, v1::MeasureResponse*) override;

 private:
  // Serves TrackMesh. Its requests are read as bytes, since gRPC would take an unreadable message for the stream's end.
  grpc::Status track_mesh(grpc::ServerContext& context, TrackMeshStream& stream);

  const scenes::SceneSource& scenes_;
  scenes::SceneEditor& editor_;
  engine::Engine& engine_;
  const Limits& limits_;
  std::atomic<int> tracked_ = 0;
};

}  // namespace isofield::rpc
