// Names of what a catalog holds.
#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield::catalog {

// INVALID_ARGUMENT: not 1 to 128 characters of A-Z a-z 0-9 _ - . /
absl::Status check_name(const std::string& name);

}  // namespace isofield::catalog
