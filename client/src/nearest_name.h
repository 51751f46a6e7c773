// Which of the names that exist a mistyped one was meant to be.
#pragma once

#include <absl/strings/string_view.h>

#include <string>
#include <vector>

namespace isofield {

// The name that the fewest insertions, deletions, replacements and swaps of neighbouring letters make of `wanted`;
// upper and lower case are the same. Empty where that is more than a third of its letters, and more than one.
std::string nearest_name(absl::string_view wanted, const std::vector<std::string>& names);

// `; did you mean "radius"?`, or nothing where no name is near.
std::string did_you_mean(absl::string_view wanted, const std::vector<std::string>& names);

}  // namespace isofield
