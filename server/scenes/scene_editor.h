// Puts, edits and removes scenes in the catalog, and keeps the scenes on the device in step with it.
#pragma once

#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "blobtree/scene/parameter_edit.h"
#include "catalog/catalog.h"
#include "engine/compile_ahead.h"
#include "engine/engine.h"
#include "scenes/resident_scenes.h"

namespace isofield::scenes {

// One version of a scene in the catalog, with a lease of its resident form.
struct StoredScene {
  catalog::Entry entry;
  engine::SceneLease lease;
};

// Thread-safe.
class SceneEditor {
 public:
  // `ahead` is told which scenes are edited or replaced; it may be null. All arguments must outlive this.
  SceneEditor(catalog::Catalog& catalog, ResidentScenes& residents, engine::Engine& engine, engine::CompileAhead* ahead)
      : catalog_(catalog), residents_(residents), engine_(engine), ahead_(ahead) {}

  // Stores a scene, and keeps `lease`, its resident form. Errors are those of Catalog::put.
  absl::StatusOr<StoredScene> put(const std::string& name, v1::Scene scene, engine::SceneLease lease,
                                  std::shared_ptr<const catalog::SceneOperators> operators,
                                  const catalog::Condition& condition);
  // Changes numbers of a scene. If `expected_version` is 0 the scene may have any version; if another change comes
  // first, the edit is then applied to its result. ABORTED: the scene has another version than expected, or other
  // changes came first 17 times in a row.
  absl::StatusOr<StoredScene> edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                   std::uint64_t expected_version);
  // Removes a scene. Requests that hold a lease of it finish. NOT_FOUND: there is no such scene.
  absl::Status remove(const std::string& name);

 private:
  absl::StatusOr<StoredScene> try_edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                       std::uint64_t expected_version);

  catalog::Catalog& catalog_;
  ResidentScenes& residents_;
  engine::Engine& engine_;
  engine::CompileAhead* const ahead_;
  // Makes changes of the catalog and of the resident scenes one step. Without it, of two puts at the same time, the
  // first scene could be kept after the second put has dropped it, and would stay resident for ever. It is held while
  // the store writes: puts then wait for one another, but no evaluation waits.
  base::Mutex residency_mutex_;
};

}  // namespace isofield::scenes
