// SurfaceService of the contract.
#pragma once

#include "engine/engine.h"
#include "isofield/v1/surface_service.grpc.pb.h"
#include "rpc/limits.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

class SurfaceService final : public v1::SurfaceService::Service {
 public:
  SurfaceService(const scenes::SceneSource& scenes, engine::Engine& engine, const Limits& limits)
      : scenes_(scenes), engine_(engine), limits_(limits) {}

  grpc::Status CastRays(grpc::ServerContext*, const v1::CastRaysRequest*, v1::CastRaysResponse*) override;
  grpc::Status ProjectPoints(grpc::ServerContext*, const v1::ProjectPointsRequest*,
                             v1::ProjectPointsResponse*) override;
  grpc::Status Contains(grpc::ServerContext*, const v1::ContainsRequest*, v1::ContainsResponse*) override;
  grpc::Status Slice(grpc::ServerContext*, const v1::SliceRequest*, v1::SliceResponse*) override;

 private:
  absl::Status cast(const grpc::ServerContext&, const v1::CastRaysRequest&, v1::CastRaysResponse&);
  absl::Status project(const grpc::ServerContext&, const v1::ProjectPointsRequest&, v1::ProjectPointsResponse&);
  absl::Status contains(const grpc::ServerContext&, const v1::ContainsRequest&, v1::ContainsResponse&);
  absl::Status slice(const grpc::ServerContext&, const v1::SliceRequest&, v1::SliceResponse&);

  const scenes::SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
};

}  // namespace isofield::rpc
