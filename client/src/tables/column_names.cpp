#include "tables/column_names.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/strip.h>

#include <algorithm>
#include <span>

#include "excerpt.h"

namespace isofield {
namespace {

constexpr const char* kUnits[] = {"nm",        "um", "mum",   "micron", "microns", "micrometer", "micrometre",
                                  "mm",        "cm", "m",     "km",     "a",       "ang",        "angstrom",
                                  "angstroms", "px", "pixel", "pixels", "vx",      "voxel",      "voxels"};
constexpr const char* kPositionWords[] = {"position", "positions", "pos",        "point",       "points",
                                          "coord",    "coords",    "coordinate", "coordinates", "center",
                                          "centre",   "centroid",  "location",   "loc",         "xyz"};
constexpr const char* kOriginWords[] = {"origin", "origins", "start"};
constexpr const char* kDirectionWords[] = {"direction", "directions", "dir"};
constexpr const char* kNormalWords[] = {"normal", "normals", "norm"};

bool is_one_of(absl::string_view word, std::span<const char* const> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The names that three columns may have: the axis stands after `letter` ("dx"), or beside one of `words` ("pos x").
struct Family {
  absl::string_view letter;
  std::span<const char* const> words;
  const char* spoken;
};
constexpr Family kPlain{"", {}, "x, y and z"};
const Family kPositions{"?", kPositionWords, "x, y and z"};
const Family kOrigins{"o", kOriginWords, "ox, oy and oz"};
const Family kDirections{"d", kDirectionWords, "dx, dy and dz"};
const Family kNormals{"n", kNormalWords, "nx, ny and nz"};

// Returns the words of a name in lower case, without a unit: "Pos_X [nm]" becomes "pos" and "x".
std::vector<std::string> words_of(absl::string_view name) {
  const std::size_t bracket = name.find_first_of("([{/");
  if (bracket != absl::string_view::npos && bracket > 0) name = name.substr(0, bracket);
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : name) {
    // Letters beyond ASCII, such as the micro sign, are kept.
    const bool is_part = absl::ascii_isalnum(static_cast<unsigned char>(c)) || static_cast<signed char>(c) < 0;
    if (is_part && !inside) words.emplace_back();
    if (is_part) words.back().push_back(absl::ascii_tolower(static_cast<unsigned char>(c)));
    inside = is_part;
  }
  const auto is_micro = [](absl::string_view word) {
    return word == "\xC2\xB5m" || word == "\xCE\xBCm" || word == "\xB5m";
  };
  if (words.size() > 1 && (is_one_of(words.back(), kUnits) || is_micro(words.back()))) words.pop_back();
  return words;
}

std::optional<std::size_t> axis_of(absl::string_view word) {
  if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') return std::nullopt;
  return static_cast<std::size_t>(word[0] - 'x');
}

std::optional<std::size_t> axis_in(const std::vector<std::string>& words, const Family& family) {
  if (words.size() == 1) {
    absl::string_view word = words[0];
    if (absl::ConsumePrefix(&word, family.letter) && axis_of(word)) return axis_of(word);
    for (const char* const known : family.words) {
      absl::string_view rest = words[0];
      if ((absl::ConsumePrefix(&rest, known) || absl::ConsumeSuffix(&rest, known)) && axis_of(rest))
        return axis_of(rest);
    }
  }
  if (words.size() != 2) return std::nullopt;
  if (is_one_of(words[0], family.words)) {
    // ParaView writes names such as "Points:0".
    const std::string& axis = words[1];
    if (axis.size() == 1 && axis[0] >= '0' && axis[0] <= '2') return static_cast<std::size_t>(axis[0] - '0');
    return axis_of(axis);
  }
  return is_one_of(words[1], family.words) ? axis_of(words[0]) : std::nullopt;
}

std::vector<const Family*> families_of(VectorRole role) {
  switch (role) {
    case VectorRole::kOrigin:
      return {&kOrigins, &kPlain, &kPositions};
    case VectorRole::kDirection:
      return {&kDirections, &kNormals, &kPlain, &kPositions};
    case VectorRole::kPosition:
      break;
  }
  return {&kPlain, &kPositions};
}

}  // namespace

absl::StatusOr<std::array<std::size_t, 3>> find_vector(const ColumnNames& names, VectorRole role) {
  const std::vector<const Family*> families = families_of(role);
  for (const Family* const family : families) {
    std::array<std::vector<std::size_t>, 3> found;
    for (std::size_t column = 0; column < names.size(); ++column) {
      if (const auto axis = axis_in(words_of(names[column]), *family)) found[*axis].push_back(column);
    }
    if (found[0].empty() && found[1].empty() && found[2].empty()) continue;
    for (const std::vector<std::size_t>& columns : found) {
      if (columns.size() == 1) continue;
      const std::string twice =
          columns.empty() ? "" : absl::StrCat(", of which \"", excerpt(names[columns[1]]), "\" is there twice");
      return absl::InvalidArgumentError(
          absl::StrCat("the columns are ", list_names(names), twice, "; expected ", family->spoken, ", each once"));
    }
    return std::array<std::size_t, 3>{found[0][0], found[1][0], found[2][0]};
  }
  return absl::InvalidArgumentError(
      absl::StrCat("the columns are ", list_names(names), "; expected ", families.front()->spoken,
                   role == VectorRole::kPosition ? "" : " (or x, y and z)", " among them"));
}

std::optional<std::size_t> find_column(const ColumnNames& names, const std::string& name) {
  std::optional<std::size_t> found;
  for (std::size_t column = 0; column < names.size(); ++column) {
    if (words_of(names[column]) != std::vector<std::string>{name}) continue;
    if (found) return std::nullopt;
    found = column;
  }
  return found;
}

std::string list_names(const ColumnNames& names) {
  std::vector<std::string> spoken;
  for (const std::string& name : names) spoken.push_back(name.empty() ? "\"\"" : name);
  return excerpt(absl::StrJoin(spoken, ", "));
}

}  // namespace isofield
