#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>

namespace isofield {

// Columns as the description of the PDB format counts them: from 1, both ends included; trimmed, or as they stand.
absl::string_view pdb_columns(absl::string_view line, std::size_t first, std::size_t last);
absl::string_view pdb_field(absl::string_view line, std::size_t first, std::size_t last);

// True where columns 31 to 54 of an atom's record hold three whole numbers of a usable size, which no boundary of
// columns cuts.
bool has_coordinates(absl::string_view line);

// The same record with its fields in their columns, where the coordinates are not: a serial number of six digits or
// more shifted the rest, tabs stand for blanks, or there are only blanks between the fields. Nothing: it cannot be told
// which field is which.
std::optional<std::string> with_fields_in_columns(absl::string_view line);

}  // namespace isofield
