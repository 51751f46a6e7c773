// The custom operators that a scene was put with.
#pragma once

#include <absl/container/btree_map.h>

#include <memory>
#include <string>

#include "blobtree/scene/operator_table.h"
#include "isofield/v1/operator.pb.h"

namespace isofield::catalog {

// They are what the names in the scene's custom nodes mean, whatever becomes of these names; immutable.
struct SceneOperators {
  blobtree::OperatorTable table;                                            // as they were read
  absl::btree_map<std::string, std::shared_ptr<const v1::Operator>> messages;  // as they were put
};

}  // namespace isofield::catalog
