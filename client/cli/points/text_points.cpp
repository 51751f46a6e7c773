#include "points/text_points.h"

#include <absl/strings/str_cat.h>

#include <cmath>

#include "points/point_notes.h"
#include "tables/swc_row.h"
#include "tables/table_head.h"

namespace isofield {
namespace {

constexpr char kExpected[] = "\"x,y,z\"";

}  // namespace

absl::StatusOr<bool> TextPoints::read_head(absl::string_view& line) {
  TableHead head;
  std::string header_place;
  while (true) {
    const auto got = lines_.next(line, kExpected);
    if (!got.ok()) return got.status();
    const bool is_row = *got && head.take(line);
    if (header_place.empty() && !head.names().empty()) header_place = lines_.place();
    if (*got && !is_row) continue;
    if (auto status = choose_columns(head, is_row ? line : ""); !status.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat(header_place.empty() ? lines_.place() : header_place, ": ", status.message()));
    }
    return is_row;
  }
}

absl::Status TextPoints::choose_columns(const TableHead& head, absl::string_view row) {
  const auto sample = head.names().empty() ? swc_row(row) : std::nullopt;
  if (sample && sample->is_root) {
    return absl::InvalidArgumentError(
        "seven columns without a header, which look like SWC (id type x y z radius parent); expected x,y,z on each "
        "line, or a header that names the columns");
  }
  const auto found = choose_vector(wanted_, head.names(), head.columns());
  if (!found.ok()) return found.status();
  std::vector<std::size_t> places(found->begin(), found->end());
  if (const auto distance = find_column(head.names(), kDistanceColumn)) {
    places.push_back(*distance);
    has_distance_ = true;
  }
  if (head.names().empty() && head.columns() > 3 && !wanted_.is_second) note_ = unnamed_columns_note(head.columns());
  numbers_.emplace(head.separator(), std::move(places), head.names());
  return absl::OkStatus();
}

absl::Status TextPoints::read(std::size_t max_points, std::vector<float>& xyz) {
  const std::size_t full = xyz.size() + 3 * max_points;
  absl::string_view line;
  if (!numbers_ && full > xyz.size()) {
    const auto is_row = read_head(line);
    if (!is_row.ok()) return is_row.status();
    if (!*is_row) return absl::OkStatus();
    if (auto status = parse(line, xyz); !status.ok()) return status;
  }
  while (xyz.size() < full) {
    const auto got = lines_.next(line, kExpected);
    if (!got.ok()) return got.status();
    if (!*got) break;
    if (is_comment(line)) continue;
    if (auto status = parse(line, xyz); !status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status TextPoints::parse(absl::string_view line, std::vector<float>& xyz) {
  double numbers[4] = {0, 0, 0, 0};
  if (auto status = numbers_->parse(line, numbers); !status.ok()) return lines_.refuse(line, status.message());
  if (has_distance_ && !std::isfinite(numbers[3])) {
    ++missed_;
    return absl::OkStatus();
  }
  for (int axis = 0; axis < 3; ++axis) {
    // Coordinates are rounded to float32, as the server computes. A number such as 1e39 would become infinite there.
    const float rounded = static_cast<float>(numbers[axis]);
    if (!std::isfinite(rounded)) return lines_.refuse(line, "expected finite coordinates that float32 can hold");
    xyz.push_back(rounded);
  }
  return absl::OkStatus();
}

std::vector<std::string> TextPoints::notes() const {
  return point_notes(lines_.name(), note_, missed_);
}

}  // namespace isofield
