#include "scenes/scene_source.h"

#include <absl/strings/str_cat.h>

#include "base/status_macros.h"

namespace isofield::scenes {
namespace {

absl::Status no_scene() {
  return absl::InvalidArgumentError("scene: expected a name, or an inline scene");
}

}  // namespace

std::string node_name(const v1::Scene& scene, std::uint32_t node) {
  const std::string& name = scene.nodes(static_cast<int>(node)).name();
  return name.empty() ? absl::StrCat("#", node) : name;
}

absl::StatusOr<LeasedScene> SceneSource::lease(const v1::SceneRef& ref) const {
  switch (ref.ref_case()) {
    case v1::SceneRef::kName: {
      ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(ref.name()));
      ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease scene, residents_.acquire(entry));
      return LeasedScene{std::move(scene), entry.version, entry.scene};
    }
    case v1::SceneRef::kInline: {
      ISOFIELD_ASSIGN_OR_RETURN(const auto operators, operators_.operators_of(ref.inline_()));
      ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease scene, engine_.make_resident(ref.inline_(), operators->table));
      const std::shared_ptr<const v1::Scene> unowned(std::shared_ptr<void>(), &ref.inline_());
      return LeasedScene{std::move(scene), 0, unowned};
    }
    default:
      return no_scene();
  }
}

absl::StatusOr<FoundScene> SceneSource::find(const v1::SceneRef& ref) const {
  switch (ref.ref_case()) {
    case v1::SceneRef::kName: {
      ISOFIELD_ASSIGN_OR_RETURN(catalog::Entry entry, catalog_.get(ref.name()));
      return FoundScene{std::move(entry.scene), std::move(entry.operators)};
    }
    case v1::SceneRef::kInline: {
      ISOFIELD_ASSIGN_OR_RETURN(auto operators, operators_.operators_of(ref.inline_()));
      return FoundScene{std::make_shared<const v1::Scene>(ref.inline_()), std::move(operators)};
    }
    default:
      return no_scene();
  }
}

}  // namespace isofield::scenes
