// Reads numbers from texts.
#pragma once

#include <absl/strings/string_view.h>

#include <charconv>
#include <optional>
#include <system_error>

namespace isofield {

// The slow path of scan_double(). It reads exponents of Fortran and numbers that a double cannot hold, and refuses
// texts that are no number.
const char* scan_rare_double(const char* begin, const char* end, double& value);

// Reads the number that a text begins with. Infinities, NaN and Fortran's exponents ("1.5D+03") are numbers too.
// Returns the end of the number, or nullptr where there is none. Numbers too large for a double become infinite, too
// small ones 0.
inline const char* scan_double(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+') {
    ++begin;
    if (begin != end && *begin == '-') return nullptr;
  }
  const auto [after, error] = std::from_chars(begin, end, value);
  const bool is_rare = error != std::errc() || (after != end && (*after == 'D' || *after == 'd'));
  return is_rare ? scan_rare_double(begin, end, value) : after;
}

// Returns the whole text as a number, or nothing where it is no number.
std::optional<double> parse_double(absl::string_view text);

// Does the same, but the number may have a comma in place of the decimal point.
std::optional<double> parse_decimal_comma(absl::string_view text);

}  // namespace isofield
