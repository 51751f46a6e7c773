#pragma once

#include <absl/status/statusor.h>

#include <array>

#include "tables/column_names.h"

namespace isofield {

// What the vectors of a table are, and how to find them where the columns have no names.
struct VectorColumns {
  VectorRole role = VectorRole::kPosition;
  // Another reader takes the origins of the same file: without names these are columns 4 to 6.
  bool is_second = false;
};

// The places of a table's vectors: by the names, else the first three of `columns`, 0 of which are those of a table
// without rows. INVALID_ARGUMENT: they are not there; says what is expected.
absl::StatusOr<std::array<std::size_t, 3>> choose_vector(const VectorColumns& wanted, const ColumnNames& names,
                                                         std::size_t columns);

}  // namespace isofield
