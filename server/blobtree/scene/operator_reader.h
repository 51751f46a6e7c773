// Composition operators of messages, checked: from a node of a scene, or from an Operator message of the catalog.
#pragma once

#include <absl/status/statusor.h>

#include <memory>

#include "base/field_reader.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"
#include "operators/operator.h"
#include "operators/reading.h"

namespace isofield::blobtree {

// INVALID_ARGUMENT: names the field, the value and what was expected.
absl::StatusOr<std::shared_ptr<const operators::Operator>> read_operator(const v1::Operator& message);
// An operator of the message's kind, which must be set, with none of its parameters read: for what holds of the kind.
operators::Operator unread_operator(const v1::Operator& message);
// An opening function by itself.
absl::StatusOr<operators::Opening> read_opening(const v1::Opening& message);

// Reads a kind from its message, with its form where the message states one.
template <class Kind, class Message>
std::shared_ptr<const operators::Operator> read_kind(const Message& message, base::FieldReader& in) {
  operators::Form form = operators::Form::kUnion;
  if constexpr (Kind::kTraits.has_form) form = operators::read_form(message.form(), in);
  return std::make_shared<const operators::Operator>(Kind::read(message, in), form);
}

}  // namespace isofield::blobtree
