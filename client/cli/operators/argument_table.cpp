#include "operators/argument_table.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_split.h>

#include <charconv>
#include <cmath>

namespace isofield {
namespace {

constexpr char kExpected[] = "a header line and rows of numbers";

bool parse_number(absl::string_view cell, float& number) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double value = 0;
  const auto [after, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || after != cell.data() + cell.size()) return false;
  number = static_cast<float>(value);
  return std::isfinite(number);
}

// Without the quotes that spreadsheets put around names.
absl::string_view bare(absl::string_view name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  return name;
}

}  // namespace

absl::StatusOr<std::unique_ptr<ArgumentTable>> ArgumentTable::open(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines.ok()) return lines.status();
  std::unique_ptr<ArgumentTable> table(new ArgumentTable(*std::move(lines)));
  if (auto status = table->read_header(); !status.ok()) return status;
  return table;
}

absl::StatusOr<bool> ArgumentTable::next_cells() {
  absl::string_view line;
  while (true) {
    const auto got = lines_->next(line, kExpected);
    if (!got.ok() || !*got) return got;
    line = absl::StripAsciiWhitespace(line);
    if (line.empty() || line.front() == '#') continue;
    if (header_.empty()) {
      for (const char separator : {',', ';', '\t'}) {
        if (line.find(separator) == absl::string_view::npos) continue;
        separator_ = separator;
        break;
      }
    }
    cells_.clear();
    if (separator_ == ' ') {
      cells_ = absl::StrSplit(line, absl::ByAnyChar(" \t"), absl::SkipEmpty());
    } else {
      cells_ = absl::StrSplit(line, separator_);
    }
    for (absl::string_view& cell : cells_) cell = absl::StripAsciiWhitespace(cell);
    return true;
  }
}

absl::Status ArgumentTable::read_header() {
  const auto got = next_cells();
  if (!got.ok()) return got.status();
  place_ = lines_->place();
  if (!*got) return absl::InvalidArgumentError(absl::StrCat(place_, ": no lines; expected ", kExpected));
  float ignored = 0;
  if (parse_number(cells_.front(), ignored)) {
    return lines_->refuse(cells_.front(), "expected a header line that names the columns");
  }
  for (const absl::string_view cell : cells_) header_.push_back(absl::AsciiStrToLower(bare(cell)));
  return absl::OkStatus();
}

absl::Status ArgumentTable::parse_row(std::vector<float>& numbers) const {
  if (cells_.size() != header_.size()) {
    return lines_->refuse(cells_.front(), absl::StrCat("begins a line of ", cells_.size(), " cells; expected ",
                                                       header_.size(), " as in the header"));
  }
  for (const std::size_t place : places_) {
    float number = 0;
    if (!parse_number(cells_[place], number)) {
      return lines_->refuse(cells_[place], absl::StrCat("expected a finite number in column ", header_[place]));
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
