#include "rpc/scene_service.h"

#include <algorithm>

#include "base/limits.h"
#include "base/status_macros.h"
#include "catalog/pages.h"
#include "rpc/answer_limit.h"
#include "rpc/parameter_edits.h"

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
  // A support without an end gets the limits of coordinates instead, since not every JSON reader accepts infinities.
  const auto within = [](double x) { return std::clamp(x, -base::kMaxCoordinate, base::kMaxCoordinate); };
  for (const double x : {box.min.x, box.min.y, box.min.z}) summary.add_support_min(within(x));
  for (const double x : {box.max.x, box.max.y, box.max.z}) summary.add_support_max(within(x));
}

}  // namespace

absl::Status SceneService::summarise(const catalog::Entry& entry, v1::SceneSummary& summary) {
  ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease lease, residents_.acquire(entry));
  fill_summary(entry, *lease, summary);
  return absl::OkStatus();
}

absl::Status SceneService::put(const v1::PutSceneRequest& request, v1::PutSceneResponse& response) {
  catalog::Condition condition;
  if (request.expect_case() == v1::PutSceneRequest::kAbsent) condition.must_be_absent = request.absent();
  if (request.expect_case() == v1::PutSceneRequest::kVersion) condition.version = request.version();
  ISOFIELD_ASSIGN_OR_RETURN(auto operators, operators_.operators_of(request.scene()));
  ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease lease, engine_.make_resident(request.scene(), operators->table));
  ISOFIELD_ASSIGN_OR_RETURN(
      const scenes::StoredScene stored,
      editor_.put(request.name(), request.scene(), std::move(lease), std::move(operators), condition));
  fill_summary(stored.entry, *stored.lease, *response.mutable_summary());
  return absl::OkStatus();
}

absl::Status SceneService::get(const v1::GetSceneRequest& request, v1::GetSceneResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(request.name()));
  // The size is checked before the scene is copied, and again with the summary.
  ISOFIELD_RETURN_IF_ERROR(AnswerLimit(request.max_answer_bytes()).admit(entry.scene->ByteSizeLong(), kSceneParts));
  *response.mutable_scene() = *entry.scene;
  return summarise(entry, *response.mutable_summary());
}

absl::Status SceneService::get_parts(const v1::GetSceneRequest& request, grpc::ServerWriter<v1::ScenePart>& writer) {
  ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(request.name()));
  v1::ScenePart part;
  ISOFIELD_RETURN_IF_ERROR(summarise(entry, *part.mutable_summary()));
  const std::string bytes = entry.scene->SerializeAsString();
  return in_parts(std::span(bytes), 1, [&](std::span<const char> data) {
    part.set_data(data.data(), data.size());
    absl::Status status = send(writer, part);
    part.clear_summary();
    return status;
  });
}

absl::Status SceneService::list(const v1::ListScenesRequest& request, v1::ListScenesResponse& response) {
  AnswerPage page;
  const auto add = [&](const catalog::Entry& entry) -> absl::StatusOr<bool> {
    v1::SceneSummary summary;
    ISOFIELD_RETURN_IF_ERROR(summarise(entry, summary));
    if (!page.admit(summary.ByteSizeLong())) {
      response.set_has_more(true);
      return false;
    }
    *response.add_scenes() = std::move(summary);
    return true;
  };
  return catalog::for_each_after(catalog_, request.after(), add);
}

absl::Status SceneService::edit(const v1::EditParametersRequest& request, v1::EditParametersResponse& response) {
  ISOFIELD_ASSIGN_OR_RETURN(const scenes::StoredScene stored,
                            editor_.edit(request.name(), read_edits(request.edits()), request.expected_version()));
  fill_summary(stored.entry, *stored.lease, *response.mutable_summary());
  return absl::OkStatus();
}

}  // namespace isofield::rpc
