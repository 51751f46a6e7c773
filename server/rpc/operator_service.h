// Implements OperatorService of the contract: it keeps custom operators, and evaluates operators without a scene.
#pragma once

#include <absl/status/statusor.h>

#include <memory>

#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/operator_service.grpc.pb.h"
#include "rpc/handler.h"
#include "rpc/limits.h"
#include "rpc/operator_arguments.h"
#include "scenes/scene_source.h"

namespace isofield::rpc {

// Thread-safe.
class OperatorService final : public v1::OperatorService::Service {
 public:
  OperatorService(catalog::OperatorCatalog& operators, const scenes::SceneSource& scenes, engine::Engine& engine,
                  const Limits& limits, Admission& admission)
      : operators_(operators), scenes_(scenes), engine_(engine), limits_(limits), admission_(admission) {}

  grpc::Status PutOperator(grpc::ServerContext* context, const v1::PutOperatorRequest* request,
                           v1::PutOperatorResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return put(*request, *response); });
  }
  grpc::Status GetOperator(grpc::ServerContext* context, const v1::GetOperatorRequest* request,
                           v1::GetOperatorResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kLargerMessages,
                         [&](Call&) { return get(*request, *response); });
  }
  grpc::Status ListOperators(grpc::ServerContext* context, const v1::ListOperatorsRequest* request,
                             v1::ListOperatorsResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return list(*request, *response); });
  }
  grpc::Status DeleteOperator(grpc::ServerContext* context, const v1::DeleteOperatorRequest* request,
                              v1::DeleteOperatorResponse*) override {
    return serve(*context, admission_, [&](Call&) { return remove(*request); });
  }
  grpc::Status EvaluateOperator(grpc::ServerContext* context, const v1::EvaluateOperatorRequest* request,
                                v1::EvaluateOperatorResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kFewerRows,
                         [&](Call& call) { return evaluate(call, *request, *response); });
  }
  grpc::Status PickOpening(grpc::ServerContext* context, const v1::PickOpeningRequest* request,
                           v1::PickOpeningResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return pick(*request, *response); });
  }

 private:
  static constexpr char kLargerMessages[] = "receive larger messages";

  absl::Status put(const v1::PutOperatorRequest& request, v1::PutOperatorResponse& response);
  absl::Status get(const v1::GetOperatorRequest& request, v1::GetOperatorResponse& response);
  absl::Status list(const v1::ListOperatorsRequest& request, v1::ListOperatorsResponse& response);
  absl::Status remove(const v1::DeleteOperatorRequest& request);
  absl::Status evaluate(Call& call, const v1::EvaluateOperatorRequest& request, v1::EvaluateOperatorResponse& response);
  absl::Status evaluate_opening(Call& call, const v1::EvaluateOperatorRequest& request,
                                v1::EvaluateOperatorResponse& response);
  absl::Status pick(const v1::PickOpeningRequest& request, v1::PickOpeningResponse& response);
  // Returns the operator that a request names or brings along.
  absl::StatusOr<std::shared_ptr<const operators::Operator>> choose(const v1::EvaluateOperatorRequest& request) const;

  catalog::OperatorCatalog& operators_;
  const scenes::SceneSource& scenes_;
  engine::Engine& engine_;
  const Limits& limits_;
  Admission& admission_;
};

}  // namespace isofield::rpc
