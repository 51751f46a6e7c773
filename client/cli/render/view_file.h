#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <optional>
#include <string>

#include "render/camera.h"

namespace isofield {

// A view file keeps the camera between pictures. It is a JSON object:
//   {"target": [0, 0, 0], "distance": 5, "direction": [0, 0, -1], "up": [0, 1, 0], "field_of_view": 28}
// All fields must be there. They are those of View: the point that the camera looks at and the distance to it in model
// units, the direction in which it looks, the direction that is upwards, and the whole opening angle along the
// picture's shorter edge in degrees.

// Reads a view. Nothing: there is no such file. INVALID_ARGUMENT: the file holds no view. Other errors: it cannot be
// read. All errors name the file.
absl::StatusOr<std::optional<View>> read_view_file(const std::string& path);

// Writes a view, which must state its target and distance. Errors are those of OutputFile.
absl::Status write_view_file(const std::string& path, const View& view);

// Says what is wrong with a view; the text is empty if nothing is. Example:
//   field_of_view = 200: expected degrees within [1, 150]
std::string view_fault(const View& view);

}  // namespace isofield
