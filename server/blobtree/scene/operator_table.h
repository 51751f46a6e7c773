// Custom operators by name, as a scene with `custom` nodes was put with them.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <memory>
#include <string>

#include "operators/operator.h"

namespace isofield::blobtree {

using OperatorTable = absl::flat_hash_map<std::string, std::shared_ptr<const operators::Operator>>;

}  // namespace isofield::blobtree
