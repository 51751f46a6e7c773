// FieldService of the contract.
#pragma once

#include <atomic>

#include "engine/engine.h"
#include "isofield/v1/field_service.grpc.pb.h"
#include "rpc/limits.h"
#include "rpc/scene_source.h"

namespace isofield::rpc {

class FieldService final : public v1::FieldService::Service {
 public:
  FieldService(const SceneSource& scenes, engine::Engine& engine, const Limits& limits)
      : scenes_(scenes), engine_(engine), limits_(limits) {}

  grpc::Status Evaluate(grpc::ServerContext*, const v1::EvaluateRequest*, v1::EvaluateResponse*) override;
  grpc::Status EvaluateStream(grpc::ServerContext*,
                              grpc::ServerReaderWriter<v1::EvaluateResponse, v1::EvaluateStreamRequest>*) override;
  grpc::Status EvaluateGrid(grpc::ServerContext*, const v1::EvaluateGridRequest*,
                            grpc::ServerWriter<v1::EvaluateGridResponse>*) override;

 private:
  // `batch` lacks the points, and where the results go.
  absl::Status evaluate(engine::PointBatch batch, const v1::Tensor& points, v1::EvaluateResponse& response);

  const SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
  std::atomic<int> open_streams_ = 0;
};

}  // namespace isofield::rpc
