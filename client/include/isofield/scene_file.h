#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <string>

#include "isofield/v1/scene.pb.h"

namespace isofield {

// Scenes on disk are proto3 JSON or the binary message (.pb), and may be packed by gzip (.json.gz). A file that begins
// like a JSON object is JSON, whatever its name is.

// INVALID_ARGUMENT: not a scene; the message names the file, the place and what is wrong there.
// NOT_FOUND, PERMISSION_DENIED ...: the file cannot be read.
absl::StatusOr<v1::Scene> read_scene_file(const std::string& path);

// The same of a text; `name` stands for the file in errors.
absl::StatusOr<v1::Scene> parse_scene_json(const std::string& json, const std::string& name);

// Proto3 JSON with a node a line, fields named as in scene.proto.
absl::StatusOr<std::string> format_scene_json(const v1::Scene& scene);

// Reads all bytes of a file. A file whose first bytes are those of gzip is unpacked, whatever its name is. NOT_FOUND,
// PERMISSION_DENIED ...: it cannot be read. INVALID_ARGUMENT: it is a damaged gzip file. RESOURCE_EXHAUSTED: it holds
// more than 4 GiB when unpacked.
absl::StatusOr<std::string> read_file(const std::string& path);

}  // namespace isofield
