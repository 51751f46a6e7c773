#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>
#include <google/protobuf/message.h>

#include <string>

namespace isofield {

// Proto3 JSON into a message. INVALID_ARGUMENT: `name` with the place, and that it is not `what` ("a scene").
absl::Status parse_json(const std::string& text, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Whether bytes begin as a JSON object does.
bool is_json(absl::string_view content);

// The content of a file that holds a message as proto3 JSON or in binary, into the message: by the content, and where
// that is no JSON object, by the name: *.pb is binary. INVALID_ARGUMENT: it is neither; as parse_json().
absl::Status parse_file(const std::string& content, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Proto3 JSON on one line, fields named as in the .proto files.
absl::StatusOr<std::string> format_json(const google::protobuf::Message& message);

}  // namespace isofield
