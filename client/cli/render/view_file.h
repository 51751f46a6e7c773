#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <optional>
#include <string>

#include "render/camera.h"

namespace isofield {

// A camera in a file, so that it stays between pictures: a JSON object
//   {"target": [0, 0, 0], "distance": 5, "direction": [0, 0, -1], "up": [0, 1, 0], "field_of_view": 28}
// with all of the fields, as View says what they are: the point that the camera looks at and its distance from it in
// model units, the direction in which it looks, what is upwards, and the whole opening angle along the picture's
// shorter edge in degrees.

// Nothing where there is no such file. INVALID_ARGUMENT: it holds no view; others: it cannot be read. Both name it.
absl::StatusOr<std::optional<View>> read_view_file(const std::string& path);

// Of a view that states its target and distance. The errors of OutputFile.
absl::Status write_view_file(const std::string& path, const View& view);

// What is wrong with a view, or nothing: "field_of_view = 200: expected degrees within [1, 150]".
std::string view_fault(const View& view);

}  // namespace isofield
