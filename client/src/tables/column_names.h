#pragma once

#include <absl/status/statusor.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isofield {

// The columns of a table by the names in its header. Case, quotes, blanks and a unit do not matter: "X (um)", "x[nm]"
// and "x_px" are x. Names in double quotes come without them.
using ColumnNames = std::vector<std::string>;

// What three columns of a table are read as.
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

// The one column of this name, in lower case. Nothing: there is none, or several.
std::optional<std::size_t> find_column(const ColumnNames& names, const std::string& name);

// "id, x, y": for errors, shortened and printable.
std::string list_names(const ColumnNames& names);

}  // namespace isofield
