#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// What a field of an operator, an opening or a silhouette accepts, as scene.proto and operator.proto state it.
struct ParameterRange {
  std::string accepts;    // "a number within [1, 64]"
  std::string otherwise;  // the default in words; empty: the field must be stated
};

// Of a field that is no message and no operand. A field without an entry has an empty range, which a test forbids.
ParameterRange range_of(const google::protobuf::FieldDescriptor& field);

}  // namespace isofield
