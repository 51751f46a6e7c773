#include "commands/view_flags.h"

#include <absl/strings/str_cat.h>

#include <cmath>
#include <map>
#include <numbers>

#include "commands/checks.h"
#include "exit_codes.h"
#include "output_file.h"
#include "render/view_file.h"

namespace isofield {
namespace {

struct Side {
  double azimuth, elevation;
};

const std::map<std::string, Side>& sides() {
  static const auto* const kSides =
      new std::map<std::string, Side>{{"front", {0, 0}}, {"back", {180, 0}},   {"right", {90, 0}},  {"left", {-90, 0}},
                                      {"top", {0, 90}},  {"bottom", {0, -90}}, {"corner", {35, 20}}};
  return *kSides;
}

// Returns the side from which a direction looks. The azimuth is 0 if it looks straight up or down.
Side side_of(const glm::dvec3& direction) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double x = direction.x, y = direction.y, z = direction.z;
  return {x == 0 && z == 0 ? 0 : std::atan2(-x, -z) * kDegrees, std::atan2(-y, std::hypot(x, z)) * kDegrees};
}

glm::dvec3 to_vector(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void ViewFlags::add_to(Command command) {
  constexpr char kGroup[] = "View";
  std::vector<std::string> names;
  for (const auto& side : sides()) names.push_back(side.first);
  command.add_option("--view", side_, "The side to look from (default: corner, azimuth 35 and elevation 20)")
      .one_of(names)
      .group(kGroup);
  command.add_option("--azimuth", azimuth_, "Degrees around y: 0 looks from the front, 90 from the right side")
      .check(within(-360, 360))
      .group(kGroup);
  command.add_option("--elevation", elevation_, "Degrees above the horizon from which to look")
      .check(within(-90, 90))
      .group(kGroup);
  command.add_option("--up", up_, "x,y,z: what is upwards in the picture (default: 0,1,0)")
      .check(number())
      .delimiter(',')
      .expected(3)
      .group(kGroup);
  command
      .add_option("--target", target_,
                  "x,y,z in model units: the point in the picture's middle (default: so that the model fills it)")
      .check(number())
      .delimiter(',')
      .expected(3)
      .group(kGroup);
  command
      .add_option("--distance", distance_,
                  "From the camera to its target, in model units (default: so that the model fills the picture)")
      .check(positive())
      .group(kGroup);
  command
      .add_option("--field-of-view", field_of_view_,
                  "Degrees: the whole opening angle along the picture's shorter edge (default: 28)")
      .check(within(1, 150))
      .group(kGroup);
  command
      .add_option("--view-file", file_,
                  "A JSON file that keeps the camera: target, distance, direction, up and field_of_view. Read where "
                  "it is there; options override it; what the picture was taken with is written back")
      .group(kGroup);
}

absl::StatusOr<View> ViewFlags::view() const {
  View view;
  if (!file_.empty()) {
    if (auto status = OutputFile::check(file_); !status.ok()) return file_error(status);
    auto kept = read_view_file(file_);
    if (!kept.ok()) return file_error(kept.status());
    if (*kept) view = **kept;
  }
  if (!side_.empty() || azimuth_ || elevation_) {
    const Side side = side_.empty() ? side_of(view.direction) : sides().at(side_);
    view.turn_to(azimuth_.value_or(side.azimuth), elevation_.value_or(side.elevation));
  }
  if (!up_.empty()) view.up = to_vector(up_);
  if (!target_.empty()) view.target = to_vector(target_);
  if (distance_) view.distance = distance_;
  if (field_of_view_) view.field_of_view = *field_of_view_;
  const std::string fault = view_fault(view);
  if (!fault.empty()) return usage_error(absl::StrCat("the view's ", fault));
  return view;
}

absl::Status ViewFlags::keep(const View& view) const {
  if (file_.empty()) return absl::OkStatus();
  const auto kept = read_view_file(file_);
  if (kept.ok() && *kept && **kept == view) return absl::OkStatus();
  const absl::Status status = write_view_file(file_, view);
  return status.ok() ? status : file_error(status);
}

}  // namespace isofield
