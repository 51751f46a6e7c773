// These functions read one node of a Scene message: they check its numbers and fill in its defaults. scene_reader
// resolves the references between nodes.
#pragma once

#include <absl/status/status.h>

#include "blobtree/scene/operator_table.h"
#include "blobtree/scene/scene.h"
#include "isofield/v1/scene.pb.h"

namespace isofield::blobtree {

// Returns what errors call a node, for example nodes[3] 'arm/upper'.
std::string node_path(std::size_t index, const v1::Node& message);

// Fills all members of `node` but `path`, which the caller has set, and `children`. scene_reader also decides the law
// of operators that take fields of either law. INVALID_ARGUMENT names the node, the field, the value and what was
// expected.
absl::Status read_node(const v1::Node& message, const OperatorTable& custom, Node& node);

// Returns the references to the node's children, in order. They point into `message`.
std::vector<const std::string*> child_references(const v1::Node& message);

}  // namespace isofield::blobtree
