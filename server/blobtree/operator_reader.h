// From the contract's Operator message to a validated operator.
#pragma once

#include <absl/status/statusor.h>

#include <memory>

#include "isofield/v1/operator.pb.h"
#include "operators/operator.h"

namespace isofield::blobtree {

// INVALID_ARGUMENT with the field, the value and what would be accepted.
absl::StatusOr<std::shared_ptr<const operators::Operator>> read_operator(const v1::Operator& message);

}  // namespace isofield::blobtree
