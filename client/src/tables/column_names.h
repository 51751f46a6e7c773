// Finds the columns of a table by the names in its header.
#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isofield {

// The names of a table's columns as its header has them, without double quotes around them. Where columns are looked
// up, case, quotes, blanks and a unit do not matter: "X (um)", "x[nm]" and "x_px" are all x.
using ColumnNames = std::vector<std::string>;

// The meaning of three columns of a table, and the names by which they are found.
enum class VectorRole {
  // The names x, y, z; without those "position x", "pos_y", "z coord", "center.x", "Points:0" and the like.
  kPosition,
  // The names ox, oy, oz or "origin x"; without those the names of a position.
  kOrigin,
  // The names dx, dy, dz or "direction x"; without those the normals nx, ny, nz; without those the names of a position.
  kDirection,
};

// Returns the indices of the three columns, in the order x, y, z. INVALID_ARGUMENT: one is missing or there twice; the
// message lists the names that there are.
absl::StatusOr<std::array<std::size_t, 3>> find_vector(const ColumnNames& names, VectorRole role);

// Returns the index of the column of this name, which is given in lower case. Returns nothing where there is none, or
// more than one.
std::optional<std::size_t> find_column(const ColumnNames& names, const std::string& name);

// Returns the names as a list for errors, such as "id, x, y". Long lists are shortened, and all characters are
// printable.
std::string list_names(const ColumnNames& names);

}  // namespace isofield
