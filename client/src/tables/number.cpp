#include "tables/number.h"

#include <absl/strings/ascii.h>
#include <absl/strings/charconv.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace isofield {
namespace {

// Reads a number such as "1.5D+03"; from_chars() stops at the D.
const char* scan_fortran_double(const char* begin, const char* exponent, const char* end, double& value) {
  const char* stop = exponent + 1;
  if (stop != end && (*stop == '+' || *stop == '-')) ++stop;
  while (stop != end && absl::ascii_isdigit(static_cast<unsigned char>(*stop))) ++stop;
  std::string text(begin, stop);
  text[static_cast<std::size_t>(exponent - begin)] = 'e';
  const char* const after = scan_double(text.data(), text.data() + text.size(), value);
  return after == text.data() + text.size() ? stop : nullptr;
}

}  // namespace

const char* scan_rare_double(const char* begin, const char* end, double& value) {
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error == std::errc()) return scan_fortran_double(begin, after, end, value);
  if (error != std::errc::result_out_of_range) return nullptr;
  // The standard function does not say whether the number is too large or too small; this one leaves the nearest.
  absl::from_chars(begin, end, value);
  value = std::abs(value) < 1 ? 0 : std::copysign(HUGE_VAL, value);
  return after;
}

std::optional<double> parse_double(absl::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  return !text.empty() && scan_double(text.data(), end, value) == end ? std::optional(value) : std::nullopt;
}

std::optional<double> parse_decimal_comma(absl::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == absl::string_view::npos) return parse_double(text);
  // "1.234,5" and "1,234,567" have separators of thousands, which differ from place to place.
  if (text.find('.') != absl::string_view::npos) return std::nullopt;
  std::string with_point(text);
  with_point[comma] = '.';
  return parse_double(with_point);
}

}  // namespace isofield
