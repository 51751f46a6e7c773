// Computes the opening angle at which the blend of two fields begins at a point that a user picks on the surface of the
// first one (Gourmel et al. 2013, section 4).
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "blobtree/geometry/vec3.h"
#include "engine/engine.h"
#include "scenes/scene_source.h"

namespace isofield::scenes {

struct OpeningPick {
  double theta = 0;       // the opening angle in degrees, at most 45
  double alpha = 0;       // the angle between the gradients of the two children, in degrees
  double f1 = 0, f2 = 0;  // the fields of the children at the point
};

// Evaluates the fields of a node's two children at `point`, which is in the node's own frame, and derives the opening
// angle. `node` is a name or "#index"; coordinates have a magnitude of at most kMaxCoordinate. INVALID_ARGUMENT: the
// node is no positive operator of two children, or the field of the first child is 0 at the point.
absl::StatusOr<OpeningPick> pick_opening(const FoundScene& found, const std::string& node, const blobtree::dvec3& point,
                                         engine::Engine& engine);

}  // namespace isofield::scenes
