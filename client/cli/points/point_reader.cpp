#include "points/point_reader.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include "importers/foreign_files.h"
#include "points/npy_points.h"
#include "points/text_points.h"

namespace isofield {

absl::StatusOr<std::unique_ptr<PointReader>> open_points(const std::string& path, const VectorColumns& wanted) {
  auto file = InputFile::open(path);
  if (!file.ok()) return file.status();
  if (absl::StartsWith(file->start(), kNpyMagic)) return open_npy_points(*std::move(file), wanted);
  const std::string name = file->name();
  const absl::string_view what = foreign_file(file->start());
  if (!what.empty() || absl::EndsWithIgnoreCase(name, ".npy")) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": ", what.empty() ? "not a NumPy array (.npy)" : what,
                                                   "; expected points as text (.csv) or as a NumPy array (.npy)"));
  }
  return std::make_unique<TextPoints>(*std::move(file), wanted);
}

}  // namespace isofield
