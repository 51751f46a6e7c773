#include "points/vector_columns.h"

#include <absl/strings/str_cat.h>

namespace isofield {

absl::StatusOr<std::array<std::size_t, 3>> choose_vector(const VectorColumns& wanted, const ColumnNames& names,
                                                         std::size_t columns) {
  if (names.empty()) {
    if (!wanted.is_second || columns == 0) return std::array<std::size_t, 3>{0, 1, 2};
    if (columns >= 6) return std::array<std::size_t, 3>{3, 4, 5};
    return absl::InvalidArgumentError(
        absl::StrCat(columns, " columns without names; expected six of a file with origins and directions"));
  }
  auto found = find_vector(names, wanted.role);
  if (!found.ok() || !wanted.is_second) return found;
  const auto origins = find_vector(names, VectorRole::kOrigin);
  if (!origins.ok() || *origins != *found) return found;
  return absl::InvalidArgumentError(absl::StrCat("the columns are ", list_names(names),
                                                 "; expected dx, dy and dz, or nx, ny and nz, besides the origins"));
}

}  // namespace isofield
