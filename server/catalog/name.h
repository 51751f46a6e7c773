// Names of what a catalog holds.
#pragma once

#include <absl/status/status.h>
#include <absl/strings/str_cat.h>

#include <string>

namespace isofield::catalog {

// INVALID_ARGUMENT: not 1 to 128 characters of A-Z a-z 0-9 _ - . /
absl::Status check_name(const std::string& name);

// "'a', 'b', ..." of the names of a map, ten at most; empty for an empty one.
template <class Map>
std::string list_names(const Map& map) {
  std::string there;
  int listed = 0;
  for (const auto& [name, entry] : map) {
    if (++listed > 10) return there + ", ...";
    absl::StrAppend(&there, listed > 1 ? ", '" : "'", name, "'");
  }
  return there;
}

}  // namespace isofield::catalog
