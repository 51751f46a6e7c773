#pragma once

#include <absl/strings/string_view.h>

#include <string>

namespace isofield {

// Returns the text with U+FFFD in the place of each byte that is not UTF-8. Names of files may have such bytes.
std::string valid_utf8(absl::string_view text);

}  // namespace isofield
