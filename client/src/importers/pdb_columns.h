// Reads the fixed columns of PDB records, and repairs records whose fields are not in their columns.
#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>

namespace isofield {

// These return the columns `first` to `last` of a line, counted as the description of the PDB format does: from 1, with
// both ends. pdb_field() also removes the blanks around them.
absl::string_view pdb_columns(absl::string_view line, std::size_t first, std::size_t last);
absl::string_view pdb_field(absl::string_view line, std::size_t first, std::size_t last);

// Returns true where columns 31 to 54 of the record of an atom hold three complete numbers of a usable size. A number
// that continues across the boundary of its columns does not count.
bool has_coordinates(absl::string_view line);

// Mends a record whose coordinates are not in their columns: a serial number of six digits or more shifted them, tabs
// stand for blanks, or only blanks separate the fields. Returns nothing where it is uncertain which field is which.
std::optional<std::string> with_fields_in_columns(absl::string_view line);

}  // namespace isofield
