#pragma once

#include <absl/strings/string_view.h>

#include <string>

namespace isofield {

// The beginning of a user's text, fit for an error message: at most 80 characters, all of them printable ASCII.
std::string excerpt(absl::string_view text);

}  // namespace isofield
