#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace isofield {

// The values that a field of an operator, an opening or a silhouette accepts, as its options in scene.proto and
// operator.proto say.
struct ParameterRange {
  std::string accepts;    // in words, such as "a number within [1, 64]"
  std::string otherwise;  // the default in words; empty where the field must be stated
};

// Returns the range of a field that is neither a message nor an operand. A test checks that every such field states
// one.
ParameterRange range_of(const google::protobuf::FieldDescriptor& field);

}  // namespace isofield
