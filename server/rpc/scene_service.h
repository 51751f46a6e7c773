// SceneService of the contract.
#pragma once

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "scenes/scene_editor.h"

namespace isofield::rpc {

class SceneService final : public v1::SceneService::Service {
 public:
  SceneService(catalog::Catalog& catalog, catalog::OperatorCatalog& operators, engine::Engine& engine,
               SceneEditor& editor)
      : catalog_(catalog), operators_(operators), engine_(engine), editor_(editor) {}

  grpc::Status PutScene(grpc::ServerContext*, const v1::PutSceneRequest*, v1::PutSceneResponse*) override;
  grpc::Status GetScene(grpc::ServerContext*, const v1::GetSceneRequest*, v1::GetSceneResponse*) override;
  grpc::Status GetSceneParts(grpc::ServerContext*, const v1::GetSceneRequest*,
                             grpc::ServerWriter<v1::ScenePart>*) override;
  grpc::Status ListScenes(grpc::ServerContext*, const v1::ListScenesRequest*, v1::ListScenesResponse*) override;
  grpc::Status DeleteScene(grpc::ServerContext*, const v1::DeleteSceneRequest*, v1::DeleteSceneResponse*) override;
  grpc::Status EditParameters(grpc::ServerContext*, const v1::EditParametersRequest*,
                              v1::EditParametersResponse*) override;

 private:
  absl::Status summarise(const catalog::Entry& entry, v1::SceneSummary& summary);

  catalog::Catalog& catalog_;
  catalog::OperatorCatalog& operators_;
  engine::Engine& engine_;
  SceneEditor& editor_;
};

}  // namespace isofield::rpc
