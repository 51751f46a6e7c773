#pragma once

#include <absl/status/status.h>
#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace isofield {

// The names that set_parameter() takes: fields, and fields of the messages in them as "opening.theta0". Operands of an
// operator are none.
std::vector<std::string> parameter_names(const google::protobuf::Message& message);

// The same names, each with what it takes: "exponent: a number".
std::vector<std::string> parameter_descriptions(const google::protobuf::Message& message);

// "NAME=VALUE" into a field of an operator or an opening. Upper and lower case are the same; "theta0" finds
// opening.theta0; the name of a message ("opening") means its enum field; lists are separated by commas.
// INVALID_ARGUMENT: no such name or value; says which there are.
absl::Status set_parameter(const std::string& assignment, google::protobuf::Message& message);

}  // namespace isofield
