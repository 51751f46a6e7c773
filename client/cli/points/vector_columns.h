#pragma once

#include <absl/status/statusor.h>

#include <array>

#include "tables/column_names.h"

namespace isofield {

// The vectors of a table that a command wants, and where they are if the columns have no names.
struct VectorColumns {
  VectorRole role = VectorRole::kPosition;
  // True where the origins are read from the same file: without names, these vectors are then columns 4 to 6.
  bool is_second = false;
};

// The places of a table's vectors: those that the names tell or, without names, as said above. `columns` is the number
// of columns, 0 for a table without rows. INVALID_ARGUMENT: they are not there; the message says what is expected.
absl::StatusOr<std::array<std::size_t, 3>> choose_vector(const VectorColumns& wanted, const ColumnNames& names,
                                                         std::size_t columns);

}  // namespace isofield
