// read_scene() makes a validated Scene of the contract's Scene message.
#pragma once

#include <absl/status/statusor.h>

#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// Reads and validates a scene. `custom` holds the operators that its `custom` nodes name. INVALID_ARGUMENT states the
// node's path, the field, the value and what would be accepted (scene.proto). The function uses no recursion, so that
// memory alone limits the depth of a scene.
absl::StatusOr<Scene> read_scene(const v1::Scene& message, const SceneLimits& limits = {},
                                 const OperatorTable& custom = {});

}  // namespace isofield::blobtree
