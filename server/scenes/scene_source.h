// From the SceneRef of a request to a lease of a resident scene.
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene.pb.h"
#include "scenes/resident_scenes.h"

namespace isofield::scenes {

struct LeasedScene {
  engine::SceneLease scene;
  std::uint64_t version = 0;  // 0: inline
  // What it was made of; of an inline one the request's own, which must outlive this.
  std::shared_ptr<const v1::Scene> message;
};

// Returns how answers name a node of a scene: its name, or "#place" where it has none.
std::string node_name(const v1::Scene& scene, std::uint32_t node);

struct FoundScene {
  std::shared_ptr<const v1::Scene> scene;
  std::shared_ptr<const catalog::SceneOperators> operators;
};

// Thread-safe.
class SceneSource {
 public:
  SceneSource(const catalog::Catalog& catalog, const catalog::OperatorCatalog& operators,
              const ResidentScenes& residents, engine::Engine& engine)
      : catalog_(catalog), operators_(operators), residents_(residents), engine_(engine) {}

  absl::StatusOr<LeasedScene> lease(const v1::SceneRef& ref) const;
  // The scene itself, of an inline one a copy.
  absl::StatusOr<FoundScene> find(const v1::SceneRef& ref) const;

 private:
  const catalog::Catalog& catalog_;
  const catalog::OperatorCatalog& operators_;
  const ResidentScenes& residents_;
  engine::Engine& engine_;
};

}  // namespace isofield::scenes
