#include "rpc/scene_service.h"

#include "blobtree/parameter_edit.h"
#include "engine/status_macros.h"
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

absl::Status SceneService::store(const std::string& name, v1::Scene scene, const engine::SceneLease& lease,
                                 std::shared_ptr<const blobtree::OperatorTable> operators,
                                 const catalog::Condition& condition, v1::SceneSummary& summary) {
  catalog::Catalog::Put put;
  {
    const std::lock_guard lock(residency_mutex_);
    ISOFIELD_ASSIGN_OR_RETURN(put, catalog_.put(name, std::move(scene), std::move(operators), condition));
    engine_.keep(put.entry.version, lease);
    if (put.replaced_version != 0) engine_.drop(put.replaced_version);
  }
  fill_summary(put.entry, *lease, summary);
  return absl::OkStatus();
}

absl::Status SceneService::summarise(const catalog::Entry& entry, v1::SceneSummary& summary) {
  ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease lease,
                            engine_.acquire(entry.version, *entry.scene, *entry.operators));
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
  return to_grpc(
      store(request->name(), request->scene(), *lease, *std::move(operators), condition, *response->mutable_summary()));
}

grpc::Status SceneService::GetScene(grpc::ServerContext*, const v1::GetSceneRequest* request,
                                    v1::GetSceneResponse* response) {
  const absl::StatusOr<catalog::Entry> entry = catalog_.get(request->name());
  if (!entry.ok()) return to_grpc(entry.status());
  *response->mutable_scene() = *entry->scene;
  return to_grpc(summarise(*entry, *response->mutable_summary()));
}

grpc::Status SceneService::ListScenes(grpc::ServerContext*, const v1::ListScenesRequest*,
                                      v1::ListScenesResponse* response) {
  for (const catalog::Entry& entry : catalog_.list()) {
    if (absl::Status s = summarise(entry, *response->add_scenes()); !s.ok()) return to_grpc(s);
  }
  return grpc::Status::OK;
}

grpc::Status SceneService::DeleteScene(grpc::ServerContext*, const v1::DeleteSceneRequest* request,
                                       v1::DeleteSceneResponse*) {
  const std::lock_guard lock(residency_mutex_);
  const absl::StatusOr<std::uint64_t> version = catalog_.remove(request->name());
  if (!version.ok()) return to_grpc(version.status());
  engine_.drop(*version);
  return grpc::Status::OK;
}

grpc::Status SceneService::EditParameters(grpc::ServerContext*, const v1::EditParametersRequest* request,
                                          v1::EditParametersResponse* response) {
  const auto edit = [&]() -> absl::Status {
    std::vector<blobtree::ParameterEdit> edits;
    for (const v1::ParameterEdit& e : request->edits()) {
      edits.push_back({e.node(), e.field(), {e.values().begin(), e.values().end()}});
    }
    ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(request->name()));
    v1::Scene scene = *entry.scene;
    ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> nodes, blobtree::apply_edits(edits, scene));
    ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease before,
                              engine_.acquire(entry.version, *entry.scene, *entry.operators));
    ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease lease, engine_.edit(*before, scene, nodes, *entry.operators));
    // Against the version that was read, so that two editors at once lose nothing.
    catalog::Condition condition;
    condition.version = request->expected_version() != 0 ? request->expected_version() : entry.version;
    return store(request->name(), std::move(scene), lease, entry.operators, condition, *response->mutable_summary());
  };
  absl::Status status = edit();
  // Without a version to insist on, an edit that lost a race applies to what won.
  for (int tries = 0; absl::IsAborted(status) && request->expected_version() == 0 && tries < 16; ++tries) {
    response->Clear();
    status = edit();
  }
  return to_grpc(status);
}

}  // namespace isofield::rpc
