#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/v1/operator.pb.h"

namespace isofield {

// Operators on disk: proto3 JSON (.json), or the binary message (.pb). Errors as in scene_file.h.
absl::StatusOr<v1::Operator> read_operator_file(const std::string& path);

// Proto3 JSON on one line, fields named as in operator.proto.
absl::StatusOr<std::string> format_operator_json(const v1::Operator& message);

}  // namespace isofield
