#pragma once

#include <absl/strings/string_view.h>

#include "points/input_file.h"
#include "points/point_reader.h"

namespace isofield {

// The bytes with which every NumPy file begins.
inline constexpr absl::string_view kNpyMagic("\x93NUMPY", 6);

// Reads points from a NumPy array, as open_points() describes. INVALID_ARGUMENT: the header is damaged, or the array
// has another type or shape; the message says what is expected.
absl::StatusOr<std::unique_ptr<PointReader>> open_npy_points(InputFile file, const VectorColumns& wanted);

}  // namespace isofield
