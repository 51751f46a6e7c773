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

// True where the content begins like a JSON object.
bool is_json(absl::string_view content);

// Reads the content of a file that holds a message in proto3 JSON or in binary. It is binary where it does not begin
// like a JSON object and `name` ends with .pb (or .pb.gz). INVALID_ARGUMENT: it is no such message; JSON's errors are
// those of parse_json().
absl::Status parse_file(const std::string& content, const std::string& name, const std::string& what,
                        google::protobuf::Message& message);

// Proto3 JSON on one line, fields named as in the .proto files.
absl::StatusOr<std::string> format_json(const google::protobuf::Message& message);

}  // namespace isofield
