// Holds the custom operators that a scene was put with.
#pragma once

#include <absl/container/btree_map.h>

#include <memory>
#include <string>

#include "blobtree/scene/operator_table.h"
#include "isofield/v1/operator.pb.h"

namespace isofield::catalog {

// The names in the scene's custom nodes mean these operators, even if the catalog later replaces or removes operators
// of these names. Both members hold the same operators; they do not change once a scene has them.
struct SceneOperators {
  blobtree::OperatorTable table;                                               // in the form that the compiler reads
  absl::btree_map<std::string, std::shared_ptr<const v1::Operator>> messages;  // the messages that were put
};

}  // namespace isofield::catalog
