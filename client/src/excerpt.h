#pragma once

#include <absl/strings/string_view.h>

#include <string>

namespace isofield {

// The beginning of a text that others wrote, for errors: at most 80 characters, all printable ASCII.
std::string excerpt(absl::string_view text);

}  // namespace isofield
