#include "rpc/geometry_arguments.h"

#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/limits.h"
#include "blobtree/tape/extent.h"

namespace isofield::rpc {
namespace {

bool is_coordinate(double x) {
  return std::abs(x) <= base::kMaxCoordinate;
}

}  // namespace

absl::StatusOr<blobtree::dvec3> read_vector(const char* name, const Numbers& v) {
  if (v.size() != 3) return absl::InvalidArgumentError(absl::StrCat(name, " holds ", v.size(), " numbers: expected 3"));
  for (int i = 0; i < 3; ++i) {
    if (!is_coordinate(v[i])) {
      return absl::InvalidArgumentError(absl::StrCat(
          name, "[", i, "] = ", v[i], ": expected a finite number of magnitude at most ", base::kMaxCoordinate));
    }
  }
  return blobtree::dvec3{v[0], v[1], v[2]};
}

void set_vector(const blobtree::dvec3& v, Numbers& out) {
  out.Clear();
  for (const double x : {v.x, v.y, v.z}) out.Add(x);
}

absl::StatusOr<double> read_length(const char* name, double length) {
  if (!(length > 0 && is_coordinate(length))) {
    return absl::InvalidArgumentError(
        absl::StrCat(name, " = ", length, ": expected a length > 0, at most ", base::kMaxCoordinate));
  }
  return length;
}

absl::StatusOr<std::optional<blobtree::Box>> read_bounds(const Numbers& low, const Numbers& high) {
  if (low.empty() && high.empty()) return std::nullopt;
  if (low.size() != 3 || high.size() != 3) {
    return absl::InvalidArgumentError(absl::StrCat("bounds_min and bounds_max hold ", low.size(), " and ", high.size(),
                                                   " numbers: expected 3 each, or none"));
  }
  for (int i = 0; i < 3; ++i) {
    if (!is_coordinate(low[i]) || !is_coordinate(high[i]) || !(low[i] < high[i])) {
      return absl::InvalidArgumentError(absl::StrCat("bounds along ", std::string(1, "xyz"[i]), " = [", low[i], ", ",
                                                     high[i], "]: expected finite numbers of magnitude at most ",
                                                     base::kMaxCoordinate, ", the first below the second"));
    }
  }
  return blobtree::Box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

absl::StatusOr<double> read_iso(std::optional<double> iso, operators::Law law) {
  if (law == operators::Law::kSigned) {
    if (!is_coordinate(iso.value_or(0))) {
      return absl::InvalidArgumentError(
          absl::StrCat("iso = ", *iso, ": expected a finite number of magnitude at most ", base::kMaxCoordinate));
    }
    return iso.value_or(0);
  }
  if (iso && !(*iso > 0 && *iso < 1)) {
    return absl::InvalidArgumentError(
        absl::StrCat("iso = ", *iso, ": expected a value within ]0, 1[, or none for 0.5"));
  }
  return iso.value_or(0.5);
}

absl::Status check_bounded(const blobtree::Tape& tape, const std::optional<blobtree::Box>& bounds, double iso) {
  if (bounds) return absl::OkStatus();
  if (!is_bounded(tape)) {
    return absl::InvalidArgumentError(
        "bounds: expected, since the operators of this scene do not bound its field by themselves");
  }
  if (tape.law == operators::Law::kSigned && iso > 0) {
    return absl::InvalidArgumentError(absl::StrCat("iso = ", iso,
                                                   ": expected a value of at most 0, or stated bounds, since a signed "
                                                   "field has no bounds of its own above 0"));
  }
  return absl::OkStatus();
}

std::optional<double> longest_support_edge(const blobtree::Tape& tape) {
  if (tape.support.empty()) return 1.0;
  if (!is_bounded(tape)) return std::nullopt;
  return blobtree::longest_edge(tape.support);
}

}  // namespace isofield::rpc
