// The opening angle that a picked point asks for ([G] section 4).
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "blobtree/geometry/vec3.h"
#include "engine/engine.h"
#include "scenes/scene_source.h"

namespace isofield::scenes {

struct OpeningPick {
  double theta = 0;  // degrees; at which the operator's surface passes through the point, at most 45
  double alpha = 0;  // degrees; between the gradients of the two children
  double f1 = 0, f2 = 0;  // the fields of the children
};

// Picks a point, of coordinates of magnitude at most kMaxCoordinate, at a node that is a name or "#place". It evaluates
// the fields of the node's children there, each in its own frame.
// INVALID_ARGUMENT: the node is no positive operator of two children, or the first field is 0 at the point.
absl::StatusOr<OpeningPick> pick_opening(const FoundScene& found, const std::string& node,
                                         const blobtree::dvec3& point, engine::Engine& engine);

}  // namespace isofield::scenes
