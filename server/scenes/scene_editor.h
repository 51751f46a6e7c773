// Puts, edits and removes scenes: in the catalog and, in step with it, on the device.
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

struct StoredScene {
  catalog::Entry entry;
  engine::SceneLease lease;
};

// Thread-safe.
class SceneEditor {
 public:
  // `ahead` is told of scenes that are edited or replaced; it may be null.
  SceneEditor(catalog::Catalog& catalog, ResidentScenes& residents, engine::Engine& engine,
              engine::CompileAhead* ahead)
      : catalog_(catalog), residents_(residents), engine_(engine), ahead_(ahead) {}

  // Stores a scene. `lease` is its resident form. Errors are those of the catalog.
  absl::StatusOr<StoredScene> put(const std::string& name, v1::Scene scene, engine::SceneLease lease,
                                  std::shared_ptr<const catalog::SceneOperators> operators,
                                  const catalog::Condition& condition);
  // Edits a scene. With `expected_version` 0 the scene may have any version, and an edit that has lost a race is
  // applied to the scene that has won. ABORTED: the scene has another version, or the edit has lost 17 races in a row.
  absl::StatusOr<StoredScene> edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                   std::uint64_t expected_version);
  absl::Status remove(const std::string& name);

 private:
  absl::StatusOr<StoredScene> try_edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                       std::uint64_t expected_version);

  catalog::Catalog& catalog_;
  ResidentScenes& residents_;
  engine::Engine& engine_;
  engine::CompileAhead* const ahead_;
  // Makes the resident scenes follow the catalog step by step. Otherwise, of two puts at once, the first scene could be
  // kept after the second put has dropped it, and would stay for good. It is held while a store writes: puts wait for
  // one another then, but no evaluation does.
  base::Mutex residency_mutex_;
};

}  // namespace isofield::scenes
