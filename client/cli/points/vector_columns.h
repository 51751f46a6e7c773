#pragma once

#include <absl/status/statusor.h>

#include <array>

#include "tables/column_names.h"

namespace isofield {

// Says which vectors of a table a command wants, and which columns have them if the columns have no names.
struct VectorColumns {
  VectorRole role = VectorRole::kPosition;
  // True where the origins are read from the same file: without names, these vectors are then columns 4 to 6.
  bool is_second = false;
};

// Returns the places of the vectors' coordinates: those that the names tell or, without names, columns 1 to 3 or 4 to
// 6. `columns` is the number of columns, 0 for a table without rows. INVALID_ARGUMENT: the vectors are not there; the
// message says what is expected.
absl::StatusOr<std::array<std::size_t, 3>> choose_vector(const VectorColumns& wanted, const ColumnNames& names,
                                                         std::size_t columns);

}  // namespace isofield
