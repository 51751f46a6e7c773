#include "rpc/scene_service.h"

#include "base/status_macros.h"
#include "rpc/answer_limit.h"
#include "rpc/parameter_edits.h"
#include "rpc/status.h"

namespace isofield::rpc {
namespace {

void fill_summary(const catalog::Entry& entry, const engine::ResidentScene& scene, v1::SceneSummary& summary) {
  summary.set_name(entry.name);
  summary.set_version(entry.version);
  summary.set_nodes(entry.scene->nodes_size());
  summary.set_primitives(scene.tape().leaves.size());
  summary.set_device_bytes(scene.device_bytes());
  const blobtree::Box& box = scene.tape().support;
  if (box.empty()) return;
  for (const double x : {box.min.x, box.min.y, box.min.z}) summary.add_support_min(x);
  for (const double x : {box.max.x, box.max.y, box.max.z}) summary.add_support_max(x);
}

}  // namespace

absl::Status SceneService::summarise(const catalog::Entry& entry, v1::SceneSummary& summary) {
  ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease lease, residents_.acquire(entry));
  fill_summary(entry, *lease, summary);
  return absl::OkStatus();
}

grpc::Status SceneService::PutScene(grpc::ServerContext*, const v1::PutSceneRequest* request,
                                    v1::PutSceneResponse* response) {
  catalog::Condition condition;
  if (request->expect_case() == v1::PutSceneRequest::kAbsent) condition.must_be_absent = request->absent();
  if (request->expect_case() == v1::PutSceneRequest::kVersion) condition.version = request->version();
  auto operators = operators_.table_for(request->scene());
  if (!operators.ok()) return to_grpc(operators.status());
  const absl::StatusOr<engine::SceneLease> lease = engine_.make_resident(request->scene(), **operators);
  if (!lease.ok()) return to_grpc(lease.status());
  const absl::StatusOr<scenes::StoredScene> stored =
      editor_.put(request->name(), request->scene(), *lease, *std::move(operators), condition);
  if (!stored.ok()) return to_grpc(stored.status());
  fill_summary(stored->entry, *stored->lease, *response->mutable_summary());
  return grpc::Status::OK;
}

grpc::Status SceneService::GetScene(grpc::ServerContext*, const v1::GetSceneRequest* request,
                                    v1::GetSceneResponse* response) {
  const absl::StatusOr<catalog::Entry> entry = catalog_.get(request->name());
  if (!entry.ok()) return to_grpc(entry.status());
  const AnswerLimit limit(request->max_answer_bytes());
  // The size is checked before the scene is copied, and again with the summary.
  const char* const instead = "ask GetSceneParts, which answers scenes of any size";
  if (absl::Status s = limit.admit(entry->scene->ByteSizeLong(), instead); !s.ok()) return to_grpc(s);
  *response->mutable_scene() = *entry->scene;
  if (absl::Status s = summarise(*entry, *response->mutable_summary()); !s.ok()) return to_grpc(s);
  return to_grpc(limit.admit(response->ByteSizeLong(), instead));
}

grpc::Status SceneService::GetSceneParts(grpc::ServerContext*, const v1::GetSceneRequest* request,
                                         grpc::ServerWriter<v1::ScenePart>* writer) {
  const absl::StatusOr<catalog::Entry> entry = catalog_.get(request->name());
  if (!entry.ok()) return to_grpc(entry.status());
  v1::ScenePart part;
  if (absl::Status s = summarise(*entry, *part.mutable_summary()); !s.ok()) return to_grpc(s);
  const std::string bytes = entry->scene->SerializeAsString();
  const bool is_sent = in_parts(std::span(bytes), 1, [&](std::span<const char> data) {
    part.set_data(data.data(), data.size());
    const bool is_written = writer->Write(part);
    part.clear_summary();
    return is_written;
  });
  return is_sent ? grpc::Status::OK : to_grpc(client_gone());
}

grpc::Status SceneService::ListScenes(grpc::ServerContext*, const v1::ListScenesRequest* request,
                                      v1::ListScenesResponse* response) {
  AnswerPage page;
  for (const catalog::Entry& entry : catalog_.list(request->after())) {
    v1::SceneSummary summary;
    if (absl::Status s = summarise(entry, summary); !s.ok()) return to_grpc(s);
    if (!page.admit(summary.ByteSizeLong())) {
      response->set_has_more(true);
      break;
    }
    *response->add_scenes() = std::move(summary);
  }
  return grpc::Status::OK;
}

grpc::Status SceneService::DeleteScene(grpc::ServerContext*, const v1::DeleteSceneRequest* request,
                                       v1::DeleteSceneResponse*) {
  return to_grpc(editor_.remove(request->name()));
}

grpc::Status SceneService::EditParameters(grpc::ServerContext*, const v1::EditParametersRequest* request,
                                          v1::EditParametersResponse* response) {
  const absl::StatusOr<scenes::StoredScene> stored =
      editor_.edit(request->name(), read_edits(request->edits()), request->expected_version());
  if (!stored.ok()) return to_grpc(stored.status());
  fill_summary(stored->entry, *stored->lease, *response->mutable_summary());
  return grpc::Status::OK;
}

}  // namespace isofield::rpc
