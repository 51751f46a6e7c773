// Shortens the texts of users for error messages.
#pragma once

#include <absl/strings/string_view.h>

#include <string>

namespace isofield {

// Returns the beginning of a text of a user: at most 80 characters, all of them printable ASCII.
std::string excerpt(absl::string_view text);

}  // namespace isofield
