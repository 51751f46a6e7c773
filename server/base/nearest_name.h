// Suggestions for mistyped names.
#pragma once

#include <absl/strings/string_view.h>

#include <string>
#include <vector>

namespace isofield::base {

// The one of `names` that needs the fewest insertions, deletions, replacements and swaps of neighbouring letters from
// `wanted`; case does not matter. Empty where it needs more of them than a third of the letters of `wanted` (but one is
// always allowed).
std::string nearest_name(absl::string_view wanted, const std::vector<std::string>& names);

// A suggestion to append to an error, such as "; did you mean 'radius'?". Empty where no name is near.
std::string did_you_mean(absl::string_view wanted, const std::vector<std::string>& names);

}  // namespace isofield::base
