// apply_edits() changes numbers of a Scene message, which are addressed by node and field.
#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// A ParameterEdit gives new values to a field of a node, or to an element of a field.
struct ParameterEdit {
  std::string node;   // a node's name, or "#i" for nodes[i]
  std::string field;  // like "radius", "radius_a" or "radiusA", "center", "center.y", "center.1", "opening.alpha0"
  std::vector<double> values;
};

// Applies all edits, or none, and returns the indices of the nodes that it changes. INVALID_ARGUMENT: there is no such
// node or numeric field, or the edit has another count of numbers than a single field or an element takes; a whole list
// takes any count. read_scene() tells whether the values are admitted.
absl::StatusOr<std::vector<std::uint32_t>> apply_edits(const std::vector<ParameterEdit>& edits, v1::Scene& scene);

}  // namespace isofield::blobtree
