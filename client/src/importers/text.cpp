#include "importers/text.h"

#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "excerpt.h"

namespace isofield {

bool LineReader::next_raw(absl::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  if (end == absl::string_view::npos) {
    line = rest_;
    rest_ = {};
  } else {
    line = rest_.substr(0, end);
    rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
  }
  ++number_;
  // A byte order mark at the start of a file is no part of its first field.
  if (number_ == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
  return true;
}

bool LineReader::next(absl::string_view& line) {
  if (!next_raw(line)) return false;
  line = absl::StripAsciiWhitespace(line);
  return true;
}

std::vector<absl::string_view> split_fields(absl::string_view line) {
  constexpr absl::string_view kSeparators = " \t,;\v\f";
  std::vector<absl::string_view> fields;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(kSeparators, at)) != absl::string_view::npos) {
    const std::size_t end = std::min(line.size(), line.find_first_of(kSeparators, at));
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

std::optional<double> parse_length(absl::string_view field) {
  const auto value = parse_double(field);
  return value && std::abs(*value) <= kLargestLength ? value : std::nullopt;
}

std::optional<absl::int128> parse_integer64(absl::string_view field) {
  // A fraction of zeros, as in "17.0", changes nothing. Plain numbers are not read as doubles, which cannot tell
  // neighbours beyond 2^53 apart.
  absl::string_view digits = field;
  const std::size_t point = field.find('.');
  if (point != absl::string_view::npos && point > 0 &&
      field.find_first_not_of('0', point + 1) == absl::string_view::npos) {
    digits = field.substr(0, point);
  }
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  std::int64_t whole = 0;
  if (absl::SimpleAtoi(digits, &whole)) return whole;
  std::uint64_t large = 0;
  if (absl::SimpleAtoi(digits, &large)) return large;
  const auto value = parse_double(field);
  // NaN fails the comparison.
  if (!value || !(std::abs(*value) <= 9007199254740992.0) || std::trunc(*value) != *value) return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

std::optional<long long> parse_integer(absl::string_view field) {
  const auto value = parse_integer64(field);
  if (!value || *value > std::numeric_limits<long long>::max()) return std::nullopt;
  return static_cast<long long>(*value);
}

std::string quote_line(std::size_t number, absl::string_view line) {
  return absl::StrCat("line ", number, ": ", excerpt(line));
}

}  // namespace isofield
