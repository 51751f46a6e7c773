// Implements SurfaceService of the contract: CastRays, ProjectPoints, Contains and Slice.
#pragma once

#include "engine/engine.h"
#include "isofield/v1/surface_service.grpc.pb.h"
#include "rpc/handler.h"
#include "rpc/limits.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// Thread-safe.
class SurfaceService final : public v1::SurfaceService::Service {
 public:
  SurfaceService(const scenes::SceneSource& scenes, engine::Engine& engine, const Limits& limits, Admission& admission)
      : scenes_(scenes), engine_(engine), limits_(limits), admission_(admission) {}

  grpc::Status CastRays(grpc::ServerContext* context, const v1::CastRaysRequest* request,
                        v1::CastRaysResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kFewerRows,
                         [&](Call& call) { return cast(call, *request, *response); });
  }
  grpc::Status ProjectPoints(grpc::ServerContext* context, const v1::ProjectPointsRequest* request,
                             v1::ProjectPointsResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kFewerRows,
                         [&](Call& call) { return project(call, *request, *response); });
  }
  grpc::Status Contains(grpc::ServerContext* context, const v1::ContainsRequest* request,
                        v1::ContainsResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kFewerRows,
                         [&](Call& call) { return contains(call, *request, *response); });
  }
  grpc::Status Slice(grpc::ServerContext* context, const v1::SliceRequest* request,
                     v1::SliceResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kSmallerPlane,
                         [&](Call& call) { return slice(call, *request, *response); });
  }

 private:
  static constexpr char kSmallerPlane[] = "ask for a part of the plane";

  absl::Status cast(Call& call, const v1::CastRaysRequest& request, v1::CastRaysResponse& response);
  absl::Status project(Call& call, const v1::ProjectPointsRequest& request, v1::ProjectPointsResponse& response);
  absl::Status contains(Call& call, const v1::ContainsRequest& request, v1::ContainsResponse& response);
  absl::Status slice(Call& call, const v1::SliceRequest& request, v1::SliceResponse& response);

  const scenes::SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
  Admission& admission_;
};

}  // namespace isofield::rpc
