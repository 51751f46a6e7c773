// Suggestions for mistyped names.
#pragma once

#include <absl/strings/string_view.h>

#include <string>
#include <vector>

namespace isofield {

// Returns the one of `names` that needs the fewest insertions, deletions, replacements and swaps of neighbouring
// letters to become `wanted`; case does not matter. Returns nothing where the nearest needs more edits than a third of
// the letters of `wanted` (one edit is always allowed).
std::string nearest_name(absl::string_view wanted, const std::vector<std::string>& names);

// Returns a suggestion to append to an error, such as `; did you mean "radius"?`, or nothing where no name is near.
std::string did_you_mean(absl::string_view wanted, const std::vector<std::string>& names);

}  // namespace isofield
