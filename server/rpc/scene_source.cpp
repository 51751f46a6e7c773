#include "rpc/scene_source.h"

#include "engine/status_macros.h"

namespace isofield::rpc {

absl::StatusOr<LeasedScene> SceneSource::lease(const v1::SceneRef& ref) const {
  switch (ref.ref_case()) {
    case v1::SceneRef::kName: {
      ISOFIELD_ASSIGN_OR_RETURN(const catalog::Entry entry, catalog_.get(ref.name()));
      ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease scene, engine_.acquire(entry.version, *entry.scene));
      return LeasedScene{std::move(scene), entry.version};
    }
    case v1::SceneRef::kInline: {
      ISOFIELD_ASSIGN_OR_RETURN(engine::SceneLease scene, engine_.make_resident(ref.inline_()));
      return LeasedScene{std::move(scene), 0};
    }
    default:
      return absl::InvalidArgumentError("scene: expected a name, or an inline scene");
  }
}

}  // namespace isofield::rpc
