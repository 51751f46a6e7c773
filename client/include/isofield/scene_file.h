// Reads scenes from files and formats them as text. A scene on disk is proto3 JSON or the binary message (.pb), and may
// be packed by gzip (.json.gz). A file that begins like a JSON object is JSON, whatever its name is.
#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <string>

#include "isofield/v1/scene.pb.h"

namespace isofield {

// Reads a scene from a file.
// INVALID_ARGUMENT: it is not a scene; the message names the file, the place and what is wrong there.
// NOT_FOUND, PERMISSION_DENIED and so on: the file cannot be read.
absl::StatusOr<v1::Scene> read_scene_file(const std::string& path);

// Reads a scene from proto3 JSON; `name` stands for the file in errors. INVALID_ARGUMENT: it is not a scene.
absl::StatusOr<v1::Scene> parse_scene_json(const std::string& json, const std::string& name);

// Returns a scene as proto3 JSON, one node a line. The fields have their names of scene.proto.
absl::StatusOr<std::string> format_scene_json(const v1::Scene& scene);

// Reads all bytes of a file. A file that begins with the bytes of gzip is unpacked, whatever its name is. NOT_FOUND,
// PERMISSION_DENIED and so on: the file cannot be read. INVALID_ARGUMENT: it is a damaged gzip file.
// RESOURCE_EXHAUSTED: it holds more than 4 GiB when unpacked.
absl::StatusOr<std::string> read_file(const std::string& path);

}  // namespace isofield
