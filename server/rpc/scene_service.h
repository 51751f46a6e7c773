// SceneService of the contract.
#pragma once

#include <mutex>

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene_service.grpc.pb.h"

namespace isofield::rpc {

class SceneService final : public v1::SceneService::Service {
 public:
  SceneService(catalog::Catalog& catalog, catalog::OperatorCatalog& operators, engine::Engine& engine)
      : catalog_(catalog), operators_(operators), engine_(engine) {}

  grpc::Status PutScene(grpc::ServerContext*, const v1::PutSceneRequest*, v1::PutSceneResponse*) override;
  grpc::Status GetScene(grpc::ServerContext*, const v1::GetSceneRequest*, v1::GetSceneResponse*) override;
  grpc::Status ListScenes(grpc::ServerContext*, const v1::ListScenesRequest*, v1::ListScenesResponse*) override;
  grpc::Status DeleteScene(grpc::ServerContext*, const v1::DeleteSceneRequest*, v1::DeleteSceneResponse*) override;
  grpc::Status EditParameters(grpc::ServerContext*, const v1::EditParametersRequest*,
                              v1::EditParametersResponse*) override;

 private:
  // `lease`: the scene's resident form.
  absl::Status store(const std::string& name, v1::Scene scene, const engine::SceneLease& lease,
                     std::shared_ptr<const blobtree::OperatorTable> operators, const catalog::Condition& condition,
                     v1::SceneSummary& summary);
  absl::Status summarise(const catalog::Entry& entry, v1::SceneSummary& summary);

  catalog::Catalog& catalog_;
  catalog::OperatorCatalog& operators_;
  engine::Engine& engine_;
  // What is resident follows what is in the catalog, step by step: or of two puts at once the first could be kept after
  // the second has dropped it, and stay for good.
  std::mutex residency_mutex_;
};

}  // namespace isofield::rpc
