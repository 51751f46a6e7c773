#include "importers/pdb_columns.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <algorithm>
#include <vector>

#include "importers/text.h"

namespace isofield {
namespace {

constexpr std::size_t kFirstCoordinate = 31;
constexpr std::size_t kCoordinateWidth = 8;
constexpr std::size_t kLastCoordinate = 54;
// The column of the decimal point within a coordinate that is written as the format demands, "%8.3f"; from 1.
constexpr std::size_t kPointColumn = 5;

bool is_blank_at(absl::string_view line, std::size_t column) {
  return column > line.size() || absl::ascii_isspace(static_cast<unsigned char>(line[column - 1]));
}

// Returns how many of the three coordinates have their decimal point where "%8.3f" puts it.
int points_in_place(absl::string_view line) {
  int points = 0;
  for (std::size_t first = kFirstCoordinate; first < kLastCoordinate; first += kCoordinateWidth) {
    points += pdb_columns(line, first + kPointColumn - 1, first + kPointColumn - 1) == ".";
  }
  return points;
}

// Returns true for a number that gemmi can read, which does not know the exponents of Fortran, such as "1.5D+03".
bool is_number(absl::string_view field) {
  return parse_length(field).has_value() && field.find_first_of("dD") == field.npos;
}

std::string without_tabs(absl::string_view line) {
  constexpr std::size_t kTabStop = 8;
  std::string result;
  for (const char c : line) {
    result += c == '\t' ? ' ' : c;
    while (c == '\t' && result.size() % kTabStop != 0) result += ' ';
  }
  return result;
}

// Returns how many digits of the serial number do not fit columns 7 to 11.
std::size_t excess_digits(absl::string_view line) {
  const absl::string_view serial = pdb_columns(line, 7, line.size());
  const std::size_t begin = std::min(serial.size(), serial.find_first_not_of(' '));
  const std::size_t end = std::min(serial.size(), serial.find_first_not_of("0123456789", begin));
  return begin == 0 && end > 5 ? end - 5 : 0;
}

// Returns true for "17", "-3" and "17A", and for a number right after its chain, "A1000".
bool is_residue_number(absl::string_view field) {
  if (!field.empty() && absl::ascii_isalpha(static_cast<unsigned char>(field.front()))) field.remove_prefix(1);
  if (!field.empty() && field.front() == '-') field.remove_prefix(1);
  const std::size_t digits = std::min(field.size(), field.find_first_not_of("0123456789"));
  const absl::string_view rest = field.substr(digits);
  return digits >= 1 && digits <= 4 &&
         (rest.empty() || (rest.size() == 1 && absl::ascii_isalpha(static_cast<unsigned char>(rest[0]))));
}

// Writes fields that blanks separate into their columns. Their order is: record, serial number, name, residue, [chain],
// number, x, y, z, [occupancy, B, ... element]. Returns nothing where it is uncertain which field is which: with four
// numbers in a row it is unknown whether a coordinate or a factor is missing.
std::optional<std::string> from_fields(absl::string_view line) {
  std::vector<absl::string_view> fields = split_fields(line);
  const auto has_point = [](absl::string_view field) { return absl::StrContains(field, '.') && is_number(field); };
  const auto first = static_cast<std::size_t>(std::find_if(fields.begin(), fields.end(), has_point) - fields.begin());
  const auto end = static_cast<std::size_t>(
      std::find_if_not(fields.begin() + static_cast<std::ptrdiff_t>(first), fields.end(), has_point) - fields.begin());
  const std::size_t numbers = end - first;
  if (first < 5 || first > 6 || (numbers != 3 && numbers != 5) || !is_residue_number(fields[first - 1])) {
    return std::nullopt;
  }
  absl::string_view number = fields[first - 1];
  absl::string_view chain = first == 6 ? fields[4] : "";
  if (first == 5 && absl::ascii_isalpha(static_cast<unsigned char>(number.front()))) {
    chain = number.substr(0, 1);
    number.remove_prefix(1);
  }
  absl::string_view insertion;
  if (absl::ascii_isalpha(static_cast<unsigned char>(number.back()))) {
    insertion = number.substr(number.size() - 1);
    number.remove_suffix(1);
  }
  absl::string_view residue = fields[3], altloc;
  if (residue.size() == 4 && chain.size() == 1) {
    altloc = residue.substr(0, 1);
    residue.remove_prefix(1);
  }
  absl::string_view element = numbers == 5 && fields.size() > end ? fields.back() : "";
  // A field with which the name of the atom does not begin is the name of a segment, not an element.
  if (element.size() > 2 || !absl::StartsWithIgnoreCase(fields[2], element)) element = "";
  if (fields[2].size() > 4 || residue.size() > 3 || chain.size() > 1 || number.size() > 4) return std::nullopt;
  const std::string name = absl::StrCat(fields[2].size() < 4 ? " " : "", fields[2]);
  std::string result = absl::StrFormat("%-6s      %-4s%1s%-3s %1s%4s%1s   ", fields[0].substr(0, 6), name, altloc,
                                       residue, chain, number, insertion);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const absl::string_view coordinate = fields[first + axis];
    // A number that does not fit is cut, but keeps at least three decimals.
    if (coordinate.size() > kCoordinateWidth && coordinate.find('.') >= kCoordinateWidth - 3) return std::nullopt;
    if (coordinate.find_first_of("eEdD") != absl::string_view::npos) return std::nullopt;
    absl::StrAppendFormat(&result, "%8s", coordinate.substr(0, kCoordinateWidth));
  }
  const absl::string_view occupancy = numbers == 5 ? fields[first + 3].substr(0, 6) : "1.00";
  absl::StrAppendFormat(&result, "%6s  0.00          %2s", occupancy, element);
  return result;
}

}  // namespace

absl::string_view pdb_columns(absl::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? absl::string_view() : line.substr(first - 1, last - first + 1);
}

absl::string_view pdb_field(absl::string_view line, std::size_t first, std::size_t last) {
  return absl::StripAsciiWhitespace(pdb_columns(line, first, last));
}

bool has_coordinates(absl::string_view line) {
  const int points = points_in_place(line);
  // A line that ends within z, although its other coordinates have three decimals, is incomplete.
  if (line.size() < kLastCoordinate && points >= 2 && pdb_field(line, 44, 46).size() == 3) return false;
  const bool own_kind = points == 3;
  for (std::size_t first = kFirstCoordinate; first < kLastCoordinate; first += kCoordinateWidth) {
    const absl::string_view field = pdb_field(line, first, first + kCoordinateWidth - 1);
    if (!is_number(field)) return false;
    // Numbers in the format's "%8.3f" may fill their columns and so touch. Others may touch only before a sign.
    const bool touches = !is_blank_at(line, first - 1) && !is_blank_at(line, first) && line[first - 1] != '-';
    if (touches && !own_kind) return false;
  }
  return own_kind || is_blank_at(line, kLastCoordinate) || is_blank_at(line, kLastCoordinate + 1);
}

std::optional<std::string> with_fields_in_columns(absl::string_view line) {
  // One damaged coordinate in a line whose columns are right must not make the next number a coordinate.
  if (points_in_place(line) >= 2) return std::nullopt;
  std::string candidate = without_tabs(line);
  if (has_coordinates(candidate)) return candidate;
  if (const std::size_t excess = excess_digits(candidate); excess > 0) {
    std::string shorter = candidate;
    shorter.erase(11, excess);
    if (has_coordinates(shorter)) return shorter;
    if (points_in_place(shorter) >= 2) return std::nullopt;
  }
  if (points_in_place(candidate) >= 2) return std::nullopt;
  return from_fields(candidate);
}

}  // namespace isofield
