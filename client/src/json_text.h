// Reads and writes protobuf messages as proto3 JSON.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <absl/strings/string_view.h>
#include <google/protobuf/message.h>

#include <string>

namespace isofield {

// Reads proto3 JSON into a message. INVALID_ARGUMENT: the text is not `what` (such as "a scene"); the message states
// `name` and the place.
absl::Status parse_json(const std::string& text, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Returns true where the content begins like a JSON object.
bool is_json(absl::string_view content);

// Reads the content of a file that holds a message in proto3 JSON or in binary. It is binary where it does not begin
// like a JSON object and `name` ends with .pb (or .pb.gz). INVALID_ARGUMENT: it is no such message; the errors of JSON
// are those of parse_json().
absl::Status parse_file(const std::string& content, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Returns the message as proto3 JSON on one line. The fields have their names of the .proto files.
absl::StatusOr<std::string> format_json(const google::protobuf::Message& message);

}  // namespace isofield
