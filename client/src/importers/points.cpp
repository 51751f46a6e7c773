#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "importers/formats.h"
#include "importers/import_report.h"
#include "importers/text.h"
#include "tables/row_numbers.h"
#include "tables/swc_row.h"
#include "tables/table_head.h"

namespace isofield {
namespace {

// The R of a bare point for which neither ImportOptions::radius nor a column states one.
constexpr double kSoftRadius = 0.5;
// The r at which w(r) = (1 - r^2)^3, the field of soft objects in scene.proto, is 1/2.
const double kSurface = std::sqrt(1 - std::cbrt(0.5));
constexpr char kDropped[] = "line dropped: expected \"x y z\" with finite numbers of a usable size";

// Returns the column of R, or nothing where there is none. INVALID_ARGUMENT: the column that is asked for is not there.
absl::StatusOr<std::optional<std::size_t>> radius_column(const TableHead& head, const std::string& asked) {
  if (asked.empty()) {
    if (const auto column = find_column(head.names(), "radius")) return column;
    // Beside a column g, a column r is the red part of a colour.
    return find_column(head.names(), "g") ? std::nullopt : find_column(head.names(), "r");
  }
  std::size_t number = 0;
  if (absl::SimpleAtoi(asked, &number)) {
    if (number >= 1 && number <= head.columns()) return number - 1;
    return absl::InvalidArgumentError(
        absl::StrCat("radius column ", number, ": expected a column from 1 to ", head.columns()));
  }
  for (std::size_t column = 0; column < head.names().size(); ++column) {
    if (head.names()[column] == asked) return column;
  }
  const auto column = find_column(head.names(), absl::AsciiStrToLower(asked));
  if (column) return column;
  return absl::InvalidArgumentError(
      absl::StrCat("radius column \"", asked, "\": ",
                   head.names().empty()
                       ? "there is no header; expected a column's number from 1"
                       : absl::StrCat("expected one of the columns ", list_names(head.names()), ", or its number")));
}

// Imports a table of points, line by line.
class PointImport {
 public:
  PointImport(const ImportOptions& options, Imported& imported) : options_(options), imported_(imported) {}

  absl::Status run(const std::string& text) {
    LineReader lines(text);
    absl::string_view line;
    bool has_row = false;
    while (!has_row && lines.next(line)) has_row = head_.take(line);
    if (auto status = choose_columns(lines.number(), line); !status.ok()) return status;
    for (; has_row; has_row = lines.next(line)) {
      if (!is_comment(line)) add_point(lines.number(), line);
    }
    return absl::OkStatus();
  }

 private:
  absl::Status choose_columns(std::size_t number, absl::string_view row) {
    std::vector<std::size_t> places = {0, 1, 2};
    if (!head_.names().empty()) {
      const auto found = find_vector(head_.names(), VectorRole::kPosition);
      if (!found.ok()) return found.status();
      places.assign(found->begin(), found->end());
    }
    const auto radius = radius_column(head_, options_.radius_column);
    if (!radius.ok()) return radius.status();
    has_radius_ = radius->has_value();
    if (has_radius_) {
      for (const std::size_t place : places) {
        if (place == **radius)
          return absl::InvalidArgumentError("the radius column holds a coordinate; expected another one");
      }
      places.push_back(**radius);
    } else if (head_.names().empty() && head_.columns() > 3) {
      note(imported_.report,
           absl::StrCat("note: the lines have ", head_.columns(), " columns, and only the first three are read; ",
                        swc_row(row) || head_.columns() == 7
                            ? "is this an SWC file (id type x y z radius parent)? Then name it .swc"
                            : "the import option radius_column states which one holds radii"),
           number, row, false);
    }
    if (const auto distance = find_column(head_.names(), "distance"); distance && distance != *radius) {
      distance_place_ = places.size();
      places.push_back(*distance);
    }
    numbers_.emplace(head_.separator(), std::move(places), head_.names());
    return absl::OkStatus();
  }

  void add_point(std::size_t number, absl::string_view line) {
    ImportReport& report = imported_.report;
    ++report.read;
    std::array<double, 5> numbers{};
    if (const auto status = numbers_->parse(line, numbers.data()); !status.ok()) {
      // The message is worth repeating where it names a column of the header, or speaks of decimal commas in a second
      // clause.
      const bool is_plain = head_.names().empty() && !absl::StrContains(status.message(), ';');
      note(report, is_plain ? kDropped : absl::StrCat("line dropped: ", status.message()), number, line);
      return;
    }
    if (distance_place_ != 0 && !std::isfinite(numbers[distance_place_])) {
      note(report, "line left out: its distance is not finite, the ray hit nothing", number, line, false);
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(numbers[axis]) <= kLargestLength) continue;
      note(report, kDropped, number, line);
      return;
    }
    double soft_radius = options_.radius.value_or(kSoftRadius);
    if (has_radius_ && numbers[3] > 0 && numbers[3] <= kLargestLength) {
      soft_radius = numbers[3];
    } else if (has_radius_) {
      note(report, absl::StrCat("radius not > 0 or not of a usable size: ", soft_radius, " used"), number, line);
    }
    v1::Sphere& sphere = *imported_.scene.add_nodes()->mutable_sphere();
    for (std::size_t axis = 0; axis < 3; ++axis) sphere.add_center(numbers[axis]);
    sphere.set_radius(kSurface * soft_radius);
    sphere.set_range(options_.range.value_or((1 - kSurface) * soft_radius));
  }

  const ImportOptions& options_;
  Imported& imported_;
  TableHead head_;
  std::optional<RowNumbers> numbers_;
  bool has_radius_ = false;
  // The index of the distance among the numbers of a row; 0 where the table has no distances.
  std::size_t distance_place_ = 0;
};

}  // namespace

absl::Status import_points(const std::string& text, const ImportOptions& options, Imported& imported) {
  imported.report.format = "points (XYZ)";
  return PointImport(options, imported).run(text);
}

}  // namespace isofield
