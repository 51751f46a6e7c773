// Implements SceneService of the contract, by which clients put, get, list, edit and delete named scenes.
#pragma once

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene_service.grpc.pb.h"
#include "rpc/handler.h"
#include "scenes/resident_scenes.h"
#include "scenes/scene_editor.h"

namespace isofield::rpc {

// Thread-safe.
class SceneService final : public v1::SceneService::Service {
 public:
  SceneService(const catalog::Catalog& catalog, const catalog::OperatorCatalog& operators,
               const scenes::ResidentScenes& residents, scenes::SceneEditor& editor, engine::Engine& engine,
               Admission& admission)
      : catalog_(catalog),
        operators_(operators),
        residents_(residents),
        editor_(editor),
        engine_(engine),
        admission_(admission) {}

  grpc::Status PutScene(grpc::ServerContext* context, const v1::PutSceneRequest* request,
                        v1::PutSceneResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return put(*request, *response); });
  }
  grpc::Status GetScene(grpc::ServerContext* context, const v1::GetSceneRequest* request,
                        v1::GetSceneResponse* response) override {
    return serve_limited(*context, admission_, *request, *response, kSceneParts,
                         [&](Call&) { return get(*request, *response); });
  }
  grpc::Status GetSceneParts(grpc::ServerContext* context, const v1::GetSceneRequest* request,
                             grpc::ServerWriter<v1::ScenePart>* writer) override {
    return serve(*context, admission_, [&](Call&) { return get_parts(*request, *writer); });
  }
  grpc::Status ListScenes(grpc::ServerContext* context, const v1::ListScenesRequest* request,
                          v1::ListScenesResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return list(*request, *response); });
  }
  grpc::Status DeleteScene(grpc::ServerContext* context, const v1::DeleteSceneRequest* request,
                           v1::DeleteSceneResponse*) override {
    return serve(*context, admission_, [&](Call&) { return editor_.remove(request->name()); });
  }
  grpc::Status EditParameters(grpc::ServerContext* context, const v1::EditParametersRequest* request,
                              v1::EditParametersResponse* response) override {
    return serve(*context, admission_, [&](Call&) { return edit(*request, *response); });
  }

 private:
  static constexpr char kSceneParts[] = "ask GetSceneParts, which answers scenes of any size";

  absl::Status put(const v1::PutSceneRequest& request, v1::PutSceneResponse& response);
  absl::Status get(const v1::GetSceneRequest& request, v1::GetSceneResponse& response);
  absl::Status get_parts(const v1::GetSceneRequest& request, grpc::ServerWriter<v1::ScenePart>& writer);
  absl::Status list(const v1::ListScenesRequest& request, v1::ListScenesResponse& response);
  absl::Status edit(const v1::EditParametersRequest& request, v1::EditParametersResponse& response);
  absl::Status summarise(const catalog::Entry& entry, v1::SceneSummary& summary);

  const catalog::Catalog& catalog_;
  const catalog::OperatorCatalog& operators_;
  const scenes::ResidentScenes& residents_;
  scenes::SceneEditor& editor_;
  engine::Engine& engine_;
  Admission& admission_;
};

}  // namespace isofield::rpc
