#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <google/protobuf/message.h>

#include <string>

namespace isofield {

// Proto3 JSON into a message. INVALID_ARGUMENT: `name` with the place, and that it is not `what` ("a scene").
absl::Status parse_json(const std::string& text, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Proto3 JSON on one line, fields named as in the .proto files.
absl::StatusOr<std::string> format_json(const google::protobuf::Message& message);

}  // namespace isofield
