// The custom operators that a scene was put with, by the names that its nodes use.
#pragma once

#include <absl/container/flat_hash_map.h>

#include <memory>
#include <string>

#include "operators/operator.h"

namespace isofield::blobtree {

using OperatorTable = absl::flat_hash_map<std::string, std::shared_ptr<const operators::Operator>>;

}  // namespace isofield::blobtree
