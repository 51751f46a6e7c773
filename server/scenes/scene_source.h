// Finds the scene that a request refers to, by name or inline, and returns a lease of its resident form.
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "catalog/catalog.h"
#include "catalog/operator_catalog.h"
#include "engine/engine.h"
#include "isofield/v1/scene.pb.h"
#include "scenes/resident_scenes.h"

namespace isofield::scenes {

// A resident scene for one request.
struct LeasedScene {
  engine::SceneLease scene;
  std::uint64_t version = 0;  // 0 for an inline scene
  // The message from which the scene was made. It is the request's own for an inline scene, so that the request must
  // outlive this.
  std::shared_ptr<const v1::Scene> message;
};

// Returns how answers name a node of a scene: its name, or "#index" if it has none.
std::string node_name(const v1::Scene& scene, std::uint32_t node);

// A scene as a message, with its custom operators, for requests that need no lease.
struct FoundScene {
  std::shared_ptr<const v1::Scene> scene;
  std::shared_ptr<const catalog::SceneOperators> operators;
};

// Looks scenes up in the catalog and makes inline ones resident. Thread-safe.
class SceneSource {
 public:
  SceneSource(const catalog::Catalog& catalog, const catalog::OperatorCatalog& operators,
              const ResidentScenes& residents, engine::Engine& engine)
      : catalog_(catalog), operators_(operators), residents_(residents), engine_(engine) {}

  // Returns a lease; an inline scene is made resident for it alone. NOT_FOUND: there is no scene of this name.
  // INVALID_ARGUMENT: `ref` refers to no scene, or the scene is faulty. Other errors are those of
  // engine::Engine::make_resident.
  absl::StatusOr<LeasedScene> lease(const v1::SceneRef& ref) const;
  // Returns the scene without making it resident; an inline scene is copied. Errors are the same, but for the last.
  absl::StatusOr<FoundScene> find(const v1::SceneRef& ref) const;

 private:
  const catalog::Catalog& catalog_;
  const catalog::OperatorCatalog& operators_;
  const ResidentScenes& residents_;
  engine::Engine& engine_;
};

}  // namespace isofield::scenes
