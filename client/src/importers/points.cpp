#include <absl/strings/ascii.h>

#include <cmath>

#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/text.h"

namespace isofield {
namespace {

// R of a bare point without ImportOptions::radius.
constexpr double kSoftRadius = 0.5;
// Where w(r) = (1 - r^2)^3 is 1/2; scene.proto.
const double kSurface = std::sqrt(1 - std::cbrt(0.5));

// Fields first, first + 1, first + 2.
bool parse_center(const std::vector<absl::string_view>& fields, std::size_t first, std::array<double, 3>& center) {
  if (fields.size() < first + 3) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_length(fields[first + axis]);
    if (!value) return false;
    center[axis] = *value;
  }
  return true;
}

void import_point(const std::vector<absl::string_view>& fields, std::size_t number, absl::string_view line,
                  const ImportOptions& options, Imported& imported) {
  ++imported.report.read;
  std::array<double, 3> center;
  if (!parse_center(fields, 0, center)) {
    note(imported.report, "line dropped: expected \"x y z\" with finite numbers of a usable size", number, line);
    return;
  }
  const double soft_radius = options.radius.value_or(kSoftRadius);
  v1::Sphere& sphere = *imported.scene.add_nodes()->mutable_sphere();
  for (const double coordinate : center) sphere.add_center(coordinate);
  sphere.set_radius(kSurface * soft_radius);
  sphere.set_range(options.range.value_or((1 - kSurface) * soft_radius));
}

}  // namespace

absl::Status import_points(const std::string& text, const ImportOptions& options, Imported& imported) {
  imported.report.format = "points (XYZ)";
  LineReader lines(text);
  absl::string_view line;
  while (lines.next(line)) {
    if (line.empty() || line.front() == '#') continue;
    import_point(split_fields(line), lines.number(), line, options, imported);
  }
  return absl::OkStatus();
}

}  // namespace isofield
