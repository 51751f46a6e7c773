// OperatorService of the contract.
#pragma once

#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/operator_service.grpc.pb.h"
#include "rpc/limits.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

class OperatorService final : public v1::OperatorService::Service {
 public:
  OperatorService(catalog::OperatorCatalog& operators, const scenes::SceneSource& scenes, engine::Engine& engine,
                  const Limits& limits)
      : operators_(operators), scenes_(scenes), engine_(engine), limits_(limits) {}

  grpc::Status PutOperator(grpc::ServerContext*, const v1::PutOperatorRequest*, v1::PutOperatorResponse*) override;
  grpc::Status GetOperator(grpc::ServerContext*, const v1::GetOperatorRequest*, v1::GetOperatorResponse*) override;
  grpc::Status ListOperators(grpc::ServerContext*, const v1::ListOperatorsRequest*,
                             v1::ListOperatorsResponse*) override;
  grpc::Status DeleteOperator(grpc::ServerContext*, const v1::DeleteOperatorRequest*,
                              v1::DeleteOperatorResponse*) override;
  grpc::Status EvaluateOperator(grpc::ServerContext*, const v1::EvaluateOperatorRequest*,
                                v1::EvaluateOperatorResponse*) override;
  grpc::Status PickOpening(grpc::ServerContext*, const v1::PickOpeningRequest*, v1::PickOpeningResponse*) override;

 private:
  absl::Status pick(const v1::PickOpeningRequest& request, v1::PickOpeningResponse& response);
  absl::Status put(const v1::PutOperatorRequest& request, v1::PutOperatorResponse& response);
  absl::Status evaluate(const v1::EvaluateOperatorRequest& request, v1::EvaluateOperatorResponse& response);
  absl::Status evaluate_opening(const v1::EvaluateOperatorRequest& request, v1::EvaluateOperatorResponse& response);

  catalog::OperatorCatalog& operators_;
  const scenes::SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
};

}  // namespace isofield::rpc
