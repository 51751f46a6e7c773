#include "tables/row_numbers.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "excerpt.h"
#include "tables/number.h"

namespace isofield {
namespace {

constexpr int kIgnored = -1;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

const char* skip_blanks(const char* at, const char* end, Separator separator) {
  // Nearly all cells begin and end with no blank; they need one comparison.
  if (at == end || static_cast<unsigned char>(*at) > ' ') return at;
  while (at != end && is_blank(*at) && *at != separator) ++at;
  return at;
}

const char* skip_separators(const char* at, const char* end) {
  while (at != end && (is_blank(*at) || *at == ',' || *at == ';')) ++at;
  return at;
}

bool has_comma_between_digits(absl::string_view text) {
  for (std::size_t at = text.find(','); at != absl::string_view::npos; at = text.find(',', at + 1)) {
    if (at > 0 && at + 1 < text.size() && absl::ascii_isdigit(text[at - 1]) && absl::ascii_isdigit(text[at + 1]))
      return true;
  }
  return false;
}

// Returns true where commas in the row could be decimal commas.
bool has_decimal_commas(absl::string_view row) {
  return row.find_first_of(" \t") != absl::string_view::npos && has_comma_between_digits(row);
}

// Counts the separators. The counters are bytes, so that the compiler can use vector instructions. `has_quotes` is set
// where the text has double quotes, which make the count unreliable.
std::size_t count_separators(const char* at, const char* end, Separator separator, bool& has_quotes) {
  constexpr std::ptrdiff_t kPart = 128;
  std::size_t count = 0;
  std::uint8_t quotes = 0;
  while (at != end) {
    const std::ptrdiff_t length = std::min(kPart, end - at);
    std::uint8_t in_part = 0;
    for (std::ptrdiff_t i = 0; i < length; ++i) {
      in_part = static_cast<std::uint8_t>(in_part + (at[i] == separator));
      quotes = static_cast<std::uint8_t>(quotes | (at[i] == '"'));
    }
    count += in_part;
    at += length;
  }
  has_quotes = quotes != 0;
  return count;
}

}  // namespace

RowNumbers::RowNumbers(Separator separator, std::vector<std::size_t> places, ColumnNames names)
    : separator_(separator), names_(std::move(names)), wanted_(places.size()) {
  number_of_.resize(places.empty() ? 0 : *std::max_element(places.begin(), places.end()) + 1, kIgnored);
  for (std::size_t i = 0; i < places.size(); ++i) {
    number_of_[places[i]] = static_cast<int>(i);
    is_plain_ = is_plain_ && places[i] == i;
  }
}

// Reads the number at the start of a cell. Returns its end, which is after the closing quotes if it is quoted, or
// nullptr where there is no number.
const char* RowNumbers::scan_cell(const char* begin, const char* end, double& value) const {
  if (begin != end && *begin == '"') {
    const char* const close = std::find(begin + 1, end, '"');
    if (close == end) return nullptr;
    const auto number =
        cell_number(absl::StripAsciiWhitespace({begin + 1, static_cast<std::size_t>(close - begin - 1)}), separator_);
    value = number.value_or(0);
    return number ? close + 1 : nullptr;
  }
  const char* const after = scan_double(begin, end, value);
  if (separator_ != ';' || after == nullptr || after == end || *after != ',') return after;
  const char* const stop = cell_end(begin, end, separator_);
  const auto number = parse_decimal_comma(absl::StripAsciiWhitespace({begin, static_cast<std::size_t>(stop - begin)}));
  value = number.value_or(0);
  return number ? stop : nullptr;
}

// The fast path, for rows as programs write them: the wanted columns come first, with one separator and nothing else
// between them. `at` is the start of the row, and becomes the end of the last wanted cell. Returns false where the row
// is different.
bool RowNumbers::parse_plain(const char*& at, const char* end, double* numbers) const {
  for (std::size_t i = 0; i < wanted_; ++i) {
    if (i > 0 && (at == end || *at++ != separator_)) return false;
    const auto [after, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc()) return false;
    at = after;
  }
  return at == end || *at == separator_;
}

absl::Status RowNumbers::parse(absl::string_view row, double* numbers) const {
  const char* at = row.data();
  const char* const end = at + row.size();
  if (is_plain_ && parse_plain(at, end, numbers)) {
    if (names_.empty()) return absl::OkStatus();
    return check_count(separator_ == kBlanks ? skip_separators(at, end) : at, end, wanted_);
  }
  at = row.data();
  at = separator_ == kBlanks ? skip_separators(at, end) : skip_blanks(at, end, separator_);
  std::size_t column = 0;
  for (; column < number_of_.size(); ++column) {
    if (number_of_[column] == kIgnored) {
      if (separator_ == kBlanks) {
        if (at == end) return refuse(row, column);
        bool quoted = false;
        for (; at != end && (quoted || !(is_blank(*at) || *at == ',' || *at == ';')); ++at)
          quoted = quoted != (*at == '"');
      } else {
        at = cell_end(at, end, separator_);
      }
    } else {
      at = scan_cell(at, end, numbers[number_of_[column]]);
      if (at == nullptr) return refuse(row, column);
    }
    if (separator_ == kBlanks) {
      const char* const next = skip_separators(at, end);
      if (next == at && next != end) return refuse(row, column);
      if (at != end && *at == ',' && has_decimal_commas(absl::StripAsciiWhitespace(row))) return refuse(row, column);
      at = next;
      continue;
    }
    at = skip_blanks(at, end, separator_);
    const bool is_last = column + 1 == number_of_.size();
    if (at == end) {
      if (!is_last) return refuse(row, column + 1);
    } else if (*at != separator_) {
      return refuse(row, column);
    } else if (!is_last) {
      at = skip_blanks(at + 1, end, separator_);
    }
  }
  return names_.empty() ? absl::OkStatus() : check_count(at, end, column);
}

// Checks that the row has as many cells as the header. `at` is the separator after the last wanted cell or, with
// kBlanks, the start of the next cell.
absl::Status RowNumbers::check_count(const char* at, const char* end, std::size_t columns) const {
  if (at == end && columns == names_.size()) return absl::OkStatus();
  const absl::string_view rest(at, static_cast<std::size_t>(end - at));
  // Each separator begins another cell, except one at the line's end.
  bool has_quotes = false;
  const std::size_t separators = count_separators(at, end, separator_, has_quotes);
  if (separator_ != kBlanks && !has_quotes) {
    columns += separators;
  } else if (at != end) {
    columns += split_cells(separator_ == kBlanks ? rest : rest.substr(1), separator_).size();
  }
  if (columns == names_.size() + 1 && bare_cell(rest.substr(rest.rfind(separator_) + 1)).empty()) --columns;
  if (columns == names_.size()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("expected ", names_.size(), " cells, as many as the header names; the line has ", columns));
}

absl::Status RowNumbers::refuse(absl::string_view row, std::size_t column) const {
  std::string expected;
  if (!names_.empty() && column < names_.size()) {
    const std::vector<absl::string_view> cells = split_cells(row, separator_);
    expected = absl::StrCat("expected a number in column ", excerpt(names_[column]));
    if (cells.size() < names_.size()) {
      absl::StrAppend(&expected, " and ", names_.size(), " cells, as many as the header names; the line has ",
                      cells.size());
    }
  } else {
    expected = wanted_ == 3 ? "expected three numbers x,y,z" : absl::StrCat("expected a number in column ", column + 1);
  }
  if (separator_ != ';' && has_decimal_commas(absl::StripAsciiWhitespace(row))) {
    absl::StrAppend(&expected, "; decimal commas are read only where semicolons separate the cells");
  }
  return absl::InvalidArgumentError(expected);
}

}  // namespace isofield
