#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// The values that a field of an operator, an opening or a silhouette accepts. scene.proto and operator.proto state
// them.
struct ParameterRange {
  std::string accepts;    // in words, such as "a number within [1, 64]"
  std::string otherwise;  // the default in words; empty where the field must be stated
};

// The range of a field that is neither a message nor an operand. Every such field has an entry, as a test checks;
// without one the range is empty.
ParameterRange range_of(const google::protobuf::FieldDescriptor& field);

}  // namespace isofield
