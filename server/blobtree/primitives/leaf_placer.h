// Places a primitive in the world: its leaf, with the support box.
#pragma once

#include <absl/status/statusor.h>

#include "blobtree/scene/scene.h"
#include "blobtree/tape/tape.h"

namespace isofield::blobtree {

// `to_world` maps the node's frame to the world. INVALID_ARGUMENT: lengths leave [kMinLength, kMaxCoordinate], or the
// map's condition number is above kMaxCondition.
absl::StatusOr<Leaf> place_leaf(const Node& node, const Affine& to_world);

// vec4s of a leaf's record in the leaf buffer.
std::uint32_t leaf_record_size(Operand operand);

}  // namespace isofield::blobtree
