#pragma once

#include <absl/status/status.h>
#include <google/protobuf/message.h>

#include <string>
#include <vector>

#include "operators/parameter_ranges.h"

namespace isofield {

// The names that set_parameter() takes: fields, and fields of the messages in them as "opening.theta0". Operands of an
// operator are none.
std::vector<std::string> parameter_names(const google::protobuf::Message& message);

struct Parameter {
  std::string name;
  ParameterRange range;
};
// The same names, but for those of messages, each with what it accepts and its default.
std::vector<Parameter> describe_parameters(const google::protobuf::Message& message);

// "NAME=VALUE" into a field of an operator or an opening, by its name in the contract or in JSON ("by_angle",
// "byAngle"). Upper and lower case are the same; "theta0" finds
// opening.theta0; the name of a message ("opening") means its enum field; lists are separated by commas.
// INVALID_ARGUMENT: no such name or value; says which there are.
absl::Status set_parameter(const std::string& assignment, google::protobuf::Message& message);

}  // namespace isofield
