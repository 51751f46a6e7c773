// OperatorTable holds custom operators by name. A scene whose `custom` nodes name them is read with them.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <memory>
#include <string>

#include "operators/operator.h"

namespace isofield::blobtree {

using OperatorTable = absl::flat_hash_map<std::string, std::shared_ptr<const operators::Operator>>;

}  // namespace isofield::blobtree
