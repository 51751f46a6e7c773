// SceneService of the contract.
#pragma once

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "scenes/resident_scenes.h"
#include "scenes/scene_editor.h"

namespace isofield::rpc {

class SceneService final : public v1::SceneService::Service {
 public:
  SceneService(const catalog::Catalog& catalog, const catalog::OperatorCatalog& operators,
               const scenes::ResidentScenes& residents, scenes::SceneEditor& editor, engine::Engine& engine)
      : catalog_(catalog), operators_(operators), residents_(residents), editor_(editor), engine_(engine) {}

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

  const catalog::Catalog& catalog_;
  const catalog::OperatorCatalog& operators_;
  const scenes::ResidentScenes& residents_;
  scenes::SceneEditor& editor_;
  engine::Engine& engine_;
};

}  // namespace isofield::rpc
