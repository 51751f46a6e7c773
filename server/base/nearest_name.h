// Finds the name that a mistyped one probably means, for suggestions in errors.
#pragma once

#include <absl/strings/string_view.h>

#include <string>
#include <vector>

namespace isofield::base {

// Returns the one of `names` that `wanted` becomes with the fewest insertions, deletions, replacements and swaps of
// neighbouring letters; case does not matter. Returns "" if it takes more of them than a third of the letters of
// `wanted`; one is always allowed.
std::string nearest_name(absl::string_view wanted, const std::vector<std::string>& names);

// Returns a suggestion to append to an error, such as "; did you mean 'radius'?", or "" if no name is near.
std::string did_you_mean(absl::string_view wanted, const std::vector<std::string>& names);

}  // namespace isofield::base
