// One node of a Scene message, its numbers checked and its defaults filled in. References are left to scene_reader.
#pragma once

#include <absl/status/status.h>

#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// What errors call a node: nodes[3] 'arm/upper'.
std::string node_path(std::size_t index, const v1::Node& message);

// Fills everything of `node` but `children`; node.path is set and used in errors. The law of operators that take either
// is left to scene_reader, too.
absl::Status read_node(const v1::Node& message, const OperatorTable& custom, Node& node);

// The children that a node refers to, in order.
std::vector<const std::string*> child_references(const v1::Node& message);

}  // namespace isofield::blobtree
