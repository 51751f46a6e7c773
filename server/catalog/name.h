// Checks the names under which clients put scenes and operators into a catalog.
#pragma once

#include <absl/status/status.h>

#include <string>

namespace isofield::catalog {

// INVALID_ARGUMENT: the name does not consist of 1 to 128 characters of A-Z a-z 0-9 _ - . /
absl::Status check_name(const std::string& name);

}  // namespace isofield::catalog
