// These functions read composition operators and check them, from a node of a scene or from an Operator message of the
// catalog.
#pragma once

#include <absl/status/statusor.h>

#include <memory>

#include "base/field_reader.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"

namespace isofield::blobtree {

// Reads an operator of the catalog. INVALID_ARGUMENT names the field, the value and what was expected.
absl::StatusOr<std::shared_ptr<const operators::Operator>> read_operator(const v1::Operator& message);
// Returns an operator of the message's kind, which must be set, without reading its parameters. It serves questions
// about the kind alone.
operators::Operator unread_operator(const v1::Operator& message);
// Reads an opening function by itself, with the same errors.
absl::StatusOr<operators::Opening> read_opening(const v1::Opening& message);

// Reads an operator of one kind from its message, together with its form if the message has one. Refusals go to `in`.
template <class Kind, class Message>
std::shared_ptr<const operators::Operator> read_kind(const Message& message, base::FieldReader& in) {
  operators::Form form = operators::Form::kUnion;
  if constexpr (Kind::kTraits.has_form) form = operators::read_form(message.form(), in);
  return std::make_shared<const operators::Operator>(Kind::read(message, in), form);
}

}  // namespace isofield::blobtree
