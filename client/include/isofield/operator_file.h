// Reads custom operators from files and formats them as text.
#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/v1/operator.pb.h"

namespace isofield {

// Reads an operator from a file of proto3 JSON (.json) or of the binary message (.pb). The errors are those of
// read_scene_file() (scene_file.h).
absl::StatusOr<v1::Operator> read_operator_file(const std::string& path);

// Returns an operator as proto3 JSON on one line. The fields have their names of operator.proto.
absl::StatusOr<std::string> format_operator_json(const v1::Operator& message);

}  // namespace isofield
