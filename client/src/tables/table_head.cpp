#include "tables/table_head.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/strip.h>

namespace isofield {
namespace {

// Returns the text of a comment line, or nothing for any other line.
std::optional<absl::string_view> comment_text(absl::string_view line) {
  if (absl::ConsumePrefix(&line, "//")) return line;
  const std::size_t text = line.find_first_not_of("#%");
  if (text == 0) return std::nullopt;
  return text == absl::string_view::npos ? absl::string_view() : line.substr(text);
}

std::vector<absl::string_view> cells_of(absl::string_view line, Separator separator) {
  std::vector<absl::string_view> cells = split_cells(line, separator);
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

bool names_position(absl::string_view line) {
  const std::vector<absl::string_view> cells = split_cells(line, find_separator(line));
  return find_vector(ColumnNames(cells.begin(), cells.end()), VectorRole::kPosition).ok();
}

// Returns true where the first cell that is not empty is no number.
bool is_header(absl::string_view line, Separator separator) {
  for (const absl::string_view cell : split_cells(line, separator)) {
    if (!cell.empty()) return !cell_number(cell, ';') || names_position(line);
  }
  return false;
}

}  // namespace

bool is_comment(absl::string_view line) {
  // Nearly all lines are rows, which begin with a digit or a sign; this decides them quickly.
  if (!line.empty() && (absl::ascii_isdigit(line.front()) || line.front() == '-')) return false;
  line = absl::StripAsciiWhitespace(line);
  return line.empty() || line.front() == '#' || line.front() == '%' || absl::StartsWith(line, "//");
}

void TableHead::set_names(absl::string_view line, Separator separator) {
  for (const absl::string_view cell : cells_of(line, separator)) names_.emplace_back(cell);
  separator_ = separator;
  has_names_ = true;
}

bool TableHead::take(absl::string_view line) {
  line = absl::StripAsciiWhitespace(line);
  if (line.empty()) return false;
  if (const auto text = comment_text(line)) {
    comment_ = std::string(*text);
    return false;
  }
  const Separator separator = find_separator(line);
  if (!has_names_) {
    if (absl::StartsWithIgnoreCase(line, "sep=") && line.size() <= 5) return false;
    if (is_header(line, separator)) {
      set_names(line, separator);
      return false;
    }
    if (names_position(comment_) &&
        cells_of(comment_, find_separator(comment_)).size() == cells_of(line, separator).size()) {
      set_names(comment_, find_separator(comment_));
    }
  }
  // Rows may have another separator than the header.
  columns_ = cells_of(line, separator_).size();
  if (!has_names_ || (columns_ != names_.size() && cells_of(line, separator).size() == names_.size())) {
    separator_ = separator;
    columns_ = cells_of(line, separator).size();
  }
  return true;
}

}  // namespace isofield
