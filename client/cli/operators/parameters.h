#pragma once

#include <absl/status/status.h>
#include <google/protobuf/message.h>

#include <string>
#include <vector>

#include "operators/parameter_ranges.h"

namespace isofield {

// Returns the names that set_parameter() takes: fields, and fields of the messages in them as "opening.theta0". The
// operands of an operator are not parameters.
std::vector<std::string> parameter_names(const google::protobuf::Message& message);

// A parameter as `isofield operator show` lists it.
struct Parameter {
  std::string name;
  ParameterRange range;
};
// Returns the same names without those of messages, each with what it accepts and its default.
std::vector<Parameter> describe_parameters(const google::protobuf::Message& message);

// Writes "NAME=VALUE" into a field of an operator or an opening. NAME is that of the .proto file or of JSON
// ("by_angle", "byAngle"), in any case; "theta0" finds opening.theta0, and the name of a message ("opening") means its
// enum field. Lists are separated by commas. INVALID_ARGUMENT: there is no such name or value; the message lists those
// that exist.
absl::Status set_parameter(const std::string& assignment, google::protobuf::Message& message);

}  // namespace isofield
