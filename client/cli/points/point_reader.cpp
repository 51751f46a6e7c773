#include "points/point_reader.h"

#include <absl/strings/match.h>

namespace isofield {

absl::StatusOr<std::unique_ptr<PointReader>> open_points(const std::string& path) {
  return absl::EndsWithIgnoreCase(path, ".npy") ? open_npy_points(path) : open_csv_points(path);
}

}  // namespace isofield
