// Composition operators of messages, checked: from a node of a scene, or from an Operator message of the catalog.
#pragma once

#include <absl/status/statusor.h>

#include <memory>

#include "blobtree/scene/field_reader.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"

namespace isofield::blobtree {

// INVALID_ARGUMENT: names the field, the value and what was expected.
absl::StatusOr<std::shared_ptr<const operators::Operator>> read_operator(const v1::Operator& message);
// An opening function by itself.
absl::StatusOr<operators::Opening> read_opening(const v1::Opening& message);

// The operator of a node's own kind; null for primitives, transforms, conversions, and `custom`.
std::shared_ptr<const operators::Operator> read_operator(const v1::Node& message, FieldReader& in);

// How many operands an operator takes.
struct OperandCount {
  std::size_t least = 1, most = ~std::size_t{0};
};
OperandCount operand_count(const operators::Operator& op);

}  // namespace isofield::blobtree
