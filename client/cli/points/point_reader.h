#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <memory>
#include <string>
#include <vector>

namespace isofield {

// Reads points in chunks, so that a file of any length needs the memory of a chunk. Single-threaded.
class PointReader {
 public:
  virtual ~PointReader() = default;

  // Appends the [n, 3] coordinates of the next points, n <= max_points; none at the end.
  // INVALID_ARGUMENT: the message names the file, the line (or row) and what was expected there. Coordinates that are
  // not finite are refused here, where the line is known.
  virtual absl::Status read(std::size_t max_points, std::vector<float>& xyz) = 0;
};

// By the name: *.npy is a NumPy array, anything else text; "-" is text from the standard input.
//  - Text: a point a line, x y z, between commas, semicolons, blanks or tabs. Blank lines and lines that start with #
//    are skipped. A first line that is no number is a header; with one, columns after the third are ignored, so that
//    results can be read again.
//  - NumPy: versions 1 to 3, little-endian float32 or float64, shape (n, 3), C order.
absl::StatusOr<std::unique_ptr<PointReader>> open_points(const std::string& path);

absl::StatusOr<std::unique_ptr<PointReader>> open_csv_points(const std::string& path);
absl::StatusOr<std::unique_ptr<PointReader>> open_npy_points(const std::string& path);

}  // namespace isofield
