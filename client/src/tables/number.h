#pragma once

#include <absl/strings/string_view.h>

#include <optional>

namespace isofield {

// Reads the number that a text begins with; infinities, NaN and Fortran's exponents ("1.5D+03") included. Returns where
// it ends, or nullptr where there is none. What is too large for a double is infinite, what is too small is 0.
const char* scan_double(const char* begin, const char* end, double& value);

// The whole text as a number. Nothing: it is none.
std::optional<double> parse_double(absl::string_view text);

// The same of a number that may have a comma in place of the decimal point.
std::optional<double> parse_decimal_comma(absl::string_view text);

}  // namespace isofield
