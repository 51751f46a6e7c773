#pragma once

#include <absl/strings/string_view.h>

#include <charconv>
#include <optional>
#include <system_error>

namespace isofield {

// What scan_double() does with Fortran's exponents, with what a double cannot hold, and with what is no number.
const char* scan_rare_double(const char* begin, const char* end, double& value);

// Reads the number that a text begins with; infinities, NaN and Fortran's exponents ("1.5D+03") included. Returns where
// it ends, or nullptr where there is none. What is too large for a double is infinite, what is too small is 0.
inline const char* scan_double(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+') {
    ++begin;
    if (begin != end && *begin == '-') return nullptr;
  }
  const auto [after, error] = std::from_chars(begin, end, value);
  const bool is_rare = error != std::errc() || (after != end && (*after == 'D' || *after == 'd'));
  return is_rare ? scan_rare_double(begin, end, value) : after;
}

// The whole text as a number. Nothing: it is none.
std::optional<double> parse_double(absl::string_view text);

// The same of a number that may have a comma in place of the decimal point.
std::optional<double> parse_decimal_comma(absl::string_view text);

}  // namespace isofield
