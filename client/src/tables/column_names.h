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

// What three columns of a table mean, and the names by which they are found.
enum class VectorRole {
  // x, y, z; without those "position x", "pos_y", "z coord", "center.x", "Points:0" and the like.
  kPosition,
  // ox, oy, oz or "origin x"; else a position.
  kOrigin,
  // dx, dy, dz or "direction x"; else the normals nx, ny, nz; else a position.
  kDirection,
};

// The places of the three columns, in the order x, y, z. INVALID_ARGUMENT: one is missing or there twice; the message
// lists the names that there are.
absl::StatusOr<std::array<std::size_t, 3>> find_vector(const ColumnNames& names, VectorRole role);

// The place of the column of this name, which is given in lower case. Nothing: there is none, or more than one.
std::optional<std::size_t> find_column(const ColumnNames& names, const std::string& name);

// The names as a list for errors, such as "id, x, y". Long lists are shortened, and all characters are printable.
std::string list_names(const ColumnNames& names);

}  // namespace isofield
