#include "nearest_name.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_cat.h>

#include <algorithm>

namespace isofield {
namespace {

// Returns the distance of Damerau and Levenshtein in which no letter is edited twice ("optimal string alignment").
std::size_t edit_distance(absl::string_view a, absl::string_view b) {
  std::vector<std::size_t> before, row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        next[j] = std::min(next[j], before[j - 2] + 1);
      }
    }
    before = row;
    std::swap(row, next);
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(absl::string_view wanted, const std::vector<std::string>& names) {
  // Nobody types a name of this length, and comparing it with a million others would take long.
  if (wanted.size() > 64) return "";
  const std::string lower = absl::AsciiStrToLower(wanted);
  std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  std::string nearest;
  for (const std::string& name : names) {
    if (name.size() >= wanted.size() + least || name.size() + least <= wanted.size()) continue;
    const std::size_t distance = edit_distance(lower, absl::AsciiStrToLower(name));
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(absl::string_view wanted, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wanted, names);
  return nearest.empty() ? "" : absl::StrCat("; did you mean \"", nearest, "\"?");
}

}  // namespace isofield
