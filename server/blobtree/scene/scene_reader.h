// From the contract's Scene message to a validated Scene.
#pragma once

#include <absl/status/statusor.h>

#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// INVALID_ARGUMENT with the node's path, the field, the value and what would be accepted (scene.proto). Uses no
// recursion: depth is limited by memory alone.
absl::StatusOr<Scene> read_scene(const v1::Scene& message, const SceneLimits& limits = {},
                                 const OperatorTable& custom = {});

}  // namespace isofield::blobtree
