#include "operators/argument_table.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <cmath>

namespace isofield {
namespace {

constexpr char kExpected[] = "a header line and rows of numbers";

bool parse_number(absl::string_view cell, Separator separator, float& number) {
  const auto value = cell_number(cell, separator);
  number = static_cast<float>(value.value_or(0));
  return value && std::isfinite(number);
}

}  // namespace

absl::StatusOr<std::unique_ptr<ArgumentTable>> ArgumentTable::open(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file.ok()) return file.status();
  std::unique_ptr<ArgumentTable> table(new ArgumentTable(*std::move(file)));
  if (auto status = table->read_header(); !status.ok()) return status;
  return table;
}

absl::Status ArgumentTable::read_header() {
  absl::string_view line;
  while (head_.names().empty()) {
    const auto got = lines_.next(line, kExpected);
    if (!got.ok()) return got.status();
    place_ = lines_.place();
    if (!*got) return absl::InvalidArgumentError(absl::StrCat(place_, ": no lines; expected ", kExpected));
    if (head_.take(line) && head_.names().empty()) {
      return lines_.refuse(split_cells(line, head_.separator()).front(),
                           "expected a header line that names the columns");
    }
  }
  for (const std::string& name : head_.names()) header_.push_back(absl::AsciiStrToLower(name));
  return absl::OkStatus();
}

absl::StatusOr<bool> ArgumentTable::next_cells() {
  absl::string_view line;
  while (true) {
    const auto got = lines_.next(line, kExpected);
    if (!got.ok() || !*got) return got;
    if (is_comment(line)) continue;
    // The first row tells which separator the rows have.
    if (!has_row_) has_row_ = head_.take(line);
    if (!has_row_) continue;
    cells_ = split_cells(absl::StripAsciiWhitespace(line), head_.separator());
    if (cells_.size() == header_.size() + 1 && cells_.back().empty()) cells_.pop_back();
    return true;
  }
}

absl::Status ArgumentTable::parse_row(std::vector<float>& numbers) const {
  if (cells_.size() != header_.size()) {
    return lines_.refuse(cells_.front(), absl::StrCat("this begins a line of ", cells_.size(), " cells; expected ",
                                                      header_.size(), ", as in the header"));
  }
  for (const std::size_t place : places_) {
    float number = 0;
    if (!parse_number(cells_[place], head_.separator(), number)) {
      return lines_.refuse(cells_[place], absl::StrCat("expected a finite number in column ", excerpt(header_[place])));
    }
    numbers.push_back(number);
  }
  return absl::OkStatus();
}

absl::Status ArgumentTable::read(std::size_t max_rows, std::vector<float>& numbers) {
  for (std::size_t row = 0; row < max_rows; ++row) {
    const auto got = next_cells();
    if (!got.ok()) return got.status();
    if (!*got) break;
    if (auto status = parse_row(numbers); !status.ok()) return status;
  }
  return absl::OkStatus();
}

}  // namespace isofield
