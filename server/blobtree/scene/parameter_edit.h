// Edits of a scene's numbers, addressed by node and field.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

struct ParameterEdit {
  std::string node;   // a name, or "#i"
  std::string field;  // "radius", "radius_a" or "radiusA", "center", "center.y", "center.1", "opening.alpha0"
  std::vector<double> values;
};

// Applies all edits, or none. INVALID_ARGUMENT: no such node or numeric field, or another count of numbers than the
// field holds. Whether the values are admitted is for read_scene to say. Returns the nodes that are changed.
absl::StatusOr<std::vector<std::uint32_t>> apply_edits(const std::vector<ParameterEdit>& edits, v1::Scene& scene);

}  // namespace isofield::blobtree
