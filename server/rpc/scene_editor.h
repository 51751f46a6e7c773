// Puts, edits and removes scenes: in the catalog and, in step with it, on the device.
#pragma once

#include <absl/status/statusor.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "blobtree/parameter_edit.h"
#include "catalog/catalog.h"
#include "engine/compile_ahead.h"
#include "engine/engine.h"

namespace isofield::rpc {

struct StoredScene {
  catalog::Entry entry;
  engine::SceneLease lease;
};

// Thread-safe.
class SceneEditor {
 public:
  // `ahead` is told of scenes that are edited or replaced; it may be null.
  SceneEditor(catalog::Catalog& catalog, engine::Engine& engine, engine::CompileAhead* ahead)
      : catalog_(catalog), engine_(engine), ahead_(ahead) {}

  // Errors: those of the catalog. `lease`: the scene's resident form.
  absl::StatusOr<StoredScene> put(const std::string& name, v1::Scene scene, engine::SceneLease lease,
                                  std::shared_ptr<const blobtree::OperatorTable> operators,
                                  const catalog::Condition& condition);
  // `expected_version` 0: any; an edit that lost a race then applies to what won. ABORTED: another version, or 17 races
  // lost in a row.
  absl::StatusOr<StoredScene> edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                   std::uint64_t expected_version);
  absl::Status remove(const std::string& name);

 private:
  absl::StatusOr<StoredScene> try_edit(const std::string& name, const std::vector<blobtree::ParameterEdit>& edits,
                                       std::uint64_t expected_version);

  catalog::Catalog& catalog_;
  engine::Engine& engine_;
  engine::CompileAhead* const ahead_;
  // What is resident follows what is in the catalog, step by step: or of two puts at once the first could be kept after
  // the second has dropped it, and stay for good.
  std::mutex residency_mutex_;
};

// The edits as they are sent.
template <class Edits>
std::vector<blobtree::ParameterEdit> read_edits(const Edits& edits) {
  std::vector<blobtree::ParameterEdit> read;
  for (const auto& e : edits) read.push_back({e.node(), e.field(), {e.values().begin(), e.values().end()}});
  return read;
}

}  // namespace isofield::rpc
