#include "importers/xyz_columns.h"

#include <absl/strings/match.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_split.h>
#include <absl/strings/strip.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace isofield {
namespace {

constexpr absl::string_view kBlankCharacters = " \t";

// Takes a key or a value off the front of `rest`: a text in quotes, or everything up to one of `ends`.
absl::string_view take(absl::string_view& rest, absl::string_view ends) {
  absl::string_view taken;
  if (!rest.empty() && (rest[0] == '"' || rest[0] == '\'')) {
    const std::size_t close = rest.find(rest[0], 1);
    taken = rest.substr(1, close == rest.npos ? close : close - 1);
    rest.remove_prefix(close == rest.npos ? rest.size() : close + 1);
  } else {
    taken = rest.substr(0, rest.find_first_of(ends));
    rest.remove_prefix(taken.size());
  }
  return taken;
}

void drop_blanks(absl::string_view& rest) {
  rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(kBlankCharacters)));
}

// Returns the value of a key in a text such as `key=value key2="a b" flag`, with or without blanks around "=".
std::optional<absl::string_view> value_of(absl::string_view comment, absl::string_view wanted) {
  absl::string_view rest = comment;
  for (drop_blanks(rest); !rest.empty(); drop_blanks(rest)) {
    const absl::string_view key = take(rest, " \t=");
    drop_blanks(rest);
    if (!absl::ConsumePrefix(&rest, "=")) continue;
    drop_blanks(rest);
    const absl::string_view value = take(rest, kBlankCharacters);
    if (absl::EqualsIgnoreCase(key, wanted)) return value;
  }
  return std::nullopt;
}

bool is_one_of(absl::string_view name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* known) { return absl::EqualsIgnoreCase(name, known); });
}

}  // namespace

std::optional<XyzColumns> parse_columns(absl::string_view comment, bool& valid) {
  constexpr int kMostColumns = 100'000;
  const auto properties = value_of(comment, "Properties");
  valid = true;
  if (!properties) return std::nullopt;
  const std::vector<absl::string_view> parts = absl::StrSplit(*properties, ':');
  XyzColumns columns;
  columns.species.reset();
  bool has_position = false;
  std::size_t at = 0;
  valid = parts.size() % 3 == 0;
  for (std::size_t i = 0; valid && i + 2 < parts.size(); i += 3) {
    int width = 0;
    valid = absl::SimpleAtoi(parts[i + 2], &width) && width >= 1 && width <= kMostColumns;
    if (!valid) break;
    if (width == 3 && !has_position && is_one_of(parts[i], {"pos", "position", "positions"})) {
      columns.position = at;
      has_position = true;
    } else if (width == 1 && is_one_of(parts[i], {"species", "symbol", "symbols", "element"})) {
      columns.species = at;
    } else if (width == 1 && is_one_of(parts[i], {"Z", "number", "numbers", "atomic_number", "atomic_numbers"})) {
      columns.number = at;
    }
    at += static_cast<std::size_t>(width);
  }
  valid = valid && has_position;
  if (!valid) return std::nullopt;
  return columns;
}

}  // namespace isofield
