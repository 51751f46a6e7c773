#include "scenes/scene_editor.h"

#include "base/mutex.h"
#include "base/status_macros.h"

namespace isofield::scenes {

absl::StatusOr<StoredScene> SceneEditor::put(const std::string& name, v1::Scene scene, engine::SceneLease lease,
                                             std::shared_ptr<const catalog::SceneOperators> operators,
                                             const catalog::Condition& condition) {
  const base::MutexLock lock(residency_mutex_);
  ISOFIELD_ASSIGN_OR_RETURN(catalog::Catalog::Put put,
                            catalog_.put(name, std::move(scene), std::move(operators), condition));
  residents_.keep(put.entry.version, lease);
  if (put.replaced_version != 0) {
    residents_.drop(put.replaced_version);
    const std::shared_ptr<const blobtree::OperatorTable> table(put.entry.operators, &put.entry.operators->table);
    if (ahead_) ahead_->edited(put.entry.scene, table, lease);
  }
  return StoredScene{std::move(put.entry), std::move(lease)};
}

absl::Status SceneEditor::remove(const std::string& name) {
  const base::MutexLock lock(residency_mutex_);
  ISOFIELD_ASSIGN_OR_RETURN(const std::uint64_t version, catalog_.remove(name));
  residents_.drop(version);
  return absl::OkStatus();
}

absl::StatusOr<StoredScene> SceneEditor::edit(const std::string& name,
                                              const std::vector<blobtree::ParameterEdit>& edits,
                                              std::uint64_t expected_version) {
  absl::StatusOr<StoredScene> stored = try_edit(name, edits, expected_version);
  for (int tries = 0; absl::IsAborted(stored.status()) && expected_version == 0 && tries < 16; ++tries) {
    stored = try_edit(name, edits, expected_version);
  }
  return stored;
}

absl::StatusOr<StoredScene> SceneEditor::try_edit(const std::string& name,
                                                  const std::vector<blobtree::ParameterEdit>& edits,
                                                  std::uint64_t expected_version) {
  ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(name));
  v1::Scene scene = *entry.scene;
  ISOFIELD_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> nodes, blobtree::apply_edits(edits, scene));
  ISOFIELD_ASSIGN_OR_RETURN(const engine::SceneLease before, residents_.acquire(entry));
  ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease lease, engine_.edit(*before, scene, nodes, entry.operators->table));
  // The put requires the version that was read, so that of two edits at the same time neither is lost.
  catalog::Condition condition;
  condition.version = expected_version != 0 ? expected_version : entry.version;
  return put(name, std::move(scene), std::move(lease), entry.operators, condition);
}

}  // namespace isofield::scenes
