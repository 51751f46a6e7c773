// MeshService of the contract.
#pragma once

#include "engine/engine.h"
#include "isofield/v1/mesh_service.grpc.pb.h"
#include "rpc/limits.h"
#include "rpc/scene_source.h"

namespace isofield::rpc {

class MeshService final : public v1::MeshService::Service {
 public:
  MeshService(const SceneSource& scenes, engine::Engine& engine, const Limits& limits)
      : scenes_(scenes), engine_(engine), limits_(limits) {}

  grpc::Status Mesh(grpc::ServerContext*, const v1::MeshRequest*, grpc::ServerWriter<v1::MeshResponse>*) override;
  grpc::Status Measure(grpc::ServerContext*, const v1::MeshRequest*, v1::MeasureResponse*) override;

 private:
  const SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
};

}  // namespace isofield::rpc
