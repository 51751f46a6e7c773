// From the SceneRef of a request to a lease of a resident scene.
#pragma once

#include <absl/status/statusor.h>

#include "catalog/catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::rpc {

struct LeasedScene {
  engine::SceneLease scene;
  std::uint64_t version = 0;  // 0: inline
};

// Thread-safe.
class SceneSource {
 public:
  SceneSource(catalog::Catalog& catalog, engine::Engine& engine) : catalog_(catalog), engine_(engine) {}

  absl::StatusOr<LeasedScene> lease(const v1::SceneRef& ref) const;

 private:
  catalog::Catalog& catalog_;
  engine::Engine& engine_;
};

}  // namespace isofield::rpc
