#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>

namespace isofield {

// The columns `first` to `last` of a line, counted as the description of the PDB format does: from 1, with both ends.
// pdb_field() removes the blanks around them.
absl::string_view pdb_columns(absl::string_view line, std::size_t first, std::size_t last);
absl::string_view pdb_field(absl::string_view line, std::size_t first, std::size_t last);

// True where columns 31 to 54 of an atom's record hold three complete numbers of a usable size. A number that continues
// across the boundary of its columns does not count.
bool has_coordinates(absl::string_view line);

// Mends a record whose coordinates are not in their columns, because a serial number of six digits or more shifted the
// rest, tabs stand for blanks, or blanks separate the fields anyhow. Nothing: it is uncertain which field is which.
std::optional<std::string> with_fields_in_columns(absl::string_view line);

}  // namespace isofield
