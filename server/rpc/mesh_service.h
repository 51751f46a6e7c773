// Implements MeshService of the contract: Mesh, GetMeshBricks, Measure and TrackMesh.
#pragma once

#include <absl/status/statusor.h>

#include <atomic>

#include "engine/engine.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "rpc/handler.h"
#include "rpc/limits.h"
#include "rpc/mesh_messages.h"
#include "rpc/mesh_tracking.h"
#include "scenes/scene_editor.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// Thread-safe.
class MeshService final : public v1::MeshService::Service {
 public:
  MeshService(const scenes::SceneSource& scenes, scenes::SceneEditor& editor, engine::Engine& engine,
              const Limits& limits, Admission& admission);

  grpc::Status Mesh(grpc::ServerContext* context, const v1::MeshRequest* request,
                    grpc::ServerWriter<v1::MeshResponse>* writer) override {
    return serve(*context, admission_, [&](Call& call) { return mesh(call, *request, *writer); });
  }
  grpc::Status GetMeshBricks(grpc::ServerContext* context, const v1::MeshBricksRequest* request,
                             grpc::ServerWriter<v1::MeshBricksResponse>* writer) override {
    return serve(*context, admission_, [&](Call& call) { return get_bricks(call, *request, *writer); });
  }
  grpc::Status Measure(grpc::ServerContext* context, const v1::MeshRequest* request,
                       v1::MeasureResponse* response) override {
    return serve(*context, admission_, [&](Call& call) { return measure(call, *request, *response); });
  }

 private:
  absl::Status mesh(Call& call, const v1::MeshRequest& request, grpc::ServerWriter<v1::MeshResponse>& writer);
  absl::Status get_bricks(Call& call, const v1::MeshBricksRequest& request,
                          grpc::ServerWriter<v1::MeshBricksResponse>& writer);
  absl::Status measure(Call& call, const v1::MeshRequest& request, v1::MeasureResponse& response);
  // Serves TrackMesh. Its requests are read as bytes, since gRPC would take an unreadable message for the end of the
  // stream.
  absl::Status track(grpc::ServerContext& context, TrackMeshStream& stream);

  const scenes::SceneSource& scenes_;
  scenes::SceneEditor& editor_;
  engine::Engine& engine_;
  const Limits& limits_;
  Admission& admission_;
  std::atomic<int> tracked_ = 0;  // open TrackMesh calls
};

}  // namespace isofield::rpc
