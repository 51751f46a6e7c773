// FieldService of the contract.
#pragma once

#include <atomic>
#include <functional>

#include "engine/engine.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "rpc/limits.h"
#include "rpc/scene_source.h"

namespace isofield::rpc {

// Evaluate is served by EvaluateCalls.
class FieldService final : public v1::FieldService::WithAsyncMethod_Evaluate<v1::FieldService::Service> {
 public:
  FieldService(const SceneSource& scenes, engine::Engine& engine, const Limits& limits)
      : scenes_(scenes), engine_(engine), limits_(limits) {}

  // Calls `done` once, on this thread or another; all arguments must live until then.
  void evaluate(grpc::ServerContext& context, const v1::EvaluateRequest& request, v1::EvaluateResponse& response,
                std::function<void(const grpc::Status&)> done);
  grpc::Status EvaluateStream(grpc::ServerContext*,
                              grpc::ServerReaderWriter<v1::EvaluateResponse, v1::EvaluateStreamRequest>*) override;
  grpc::Status EvaluateGrid(grpc::ServerContext*, const v1::EvaluateGridRequest*,
                            grpc::ServerWriter<v1::EvaluateGridResponse>*) override;

 private:
  // `batch` lacks the points, and where the results go.
  absl::Status evaluate_now(engine::PointBatch batch, const v1::Tensor& points, v1::EvaluateResponse& response);

  const SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
  std::atomic<int> open_streams_ = 0;
};

}  // namespace isofield::rpc
