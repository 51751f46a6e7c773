#include "isofield/unit.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/string_view.h>

#include <cmath>
#include <cstddef>
#include <iterator>

namespace isofield {
namespace {

struct NamedUnit {
  const char* symbol;
  const char* stem;  // the long form, which may also end in "s"
  double metres;
};
constexpr NamedUnit kUnits[] = {
    {"m", "metre", 1},          {"m", "meter", 1},          {"km", "kilometre", 1e3},   {"km", "kilometer", 1e3},
    {"cm", "centimetre", 1e-2}, {"cm", "centimeter", 1e-2}, {"mm", "millimetre", 1e-3}, {"mm", "millimeter", 1e-3},
    {"um", "micrometre", 1e-6}, {"um", "micrometer", 1e-6}, {"um", "micron", 1e-6},     {"nm", "nanometre", 1e-9},
    {"nm", "nanometer", 1e-9},  {"pm", "picometre", 1e-12}, {"pm", "picometer", 1e-12}, {"in", "inch", 0.0254},
    {"in", "inche", 0.0254},    {"ft", "foot", 0.3048},     {"ft", "feet", 0.3048},     {"A", "angstrom", 1e-10},
    {"\u00b5m", "", 1e-6},      {"\u03bcm", "", 1e-6},      {"\u00c5", "", 1e-10},      {"\u212b", "", 1e-10}};

bool is_named(const NamedUnit& unit, absl::string_view text) {
  // Symbols differ by case: Mm is not mm.
  if (text == unit.symbol) return true;
  const absl::string_view stem = unit.stem;
  return !stem.empty() &&
         (absl::EqualsIgnoreCase(text, stem) ||
          (absl::StartsWithIgnoreCase(text, stem) && absl::EqualsIgnoreCase(text.substr(stem.size()), "s")));
}

}  // namespace

const char* const kUnitNames = "m, km, cm, mm, um, nm, pm, angstrom, in or ft, or a multiple such as \"8 nm\"";

std::optional<double> unit_in_metres(const std::string& unit) {
  absl::string_view text = absl::StripAsciiWhitespace(unit);
  std::size_t digits = 0;
  while (digits < text.size() && (absl::ascii_isdigit(text[digits]) || text[digits] == '.')) ++digits;
  // An exponent, as in "1e-3 m", is part of the number. An "e" without digits after it is not.
  if (digits > 0 && digits + 1 < text.size() && (text[digits] == 'e' || text[digits] == 'E')) {
    std::size_t end = digits + 1;
    if (text[end] == '-' || text[end] == '+') ++end;
    const std::size_t first = end;
    while (end < text.size() && absl::ascii_isdigit(text[end])) ++end;
    if (end > first) digits = end;
  }
  double factor = 1;
  if (digits > 0 && (!absl::SimpleAtod(text.substr(0, digits), &factor) || !std::isfinite(factor) || !(factor > 0))) {
    return std::nullopt;
  }
  text = absl::StripAsciiWhitespace(text.substr(digits));
  for (const NamedUnit& known : kUnits) {
    if (is_named(known, text)) return factor * known.metres;
  }
  return std::nullopt;
}

}  // namespace isofield
