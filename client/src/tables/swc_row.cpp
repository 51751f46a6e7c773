#include "tables/swc_row.h"

#include <cmath>

#include "tables/cells.h"
#include "tables/number.h"

namespace isofield {

std::optional<SwcRow> swc_row(absl::string_view line) {
  const std::vector<absl::string_view> cells = split_cells(line, kBlanks);
  if (cells.size() < 7) return std::nullopt;
  double numbers[7];
  for (std::size_t i = 0; i < 7; ++i) {
    const auto number = parse_double(cells[i]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  for (const std::size_t i : {0, 1, 6}) {
    if (std::trunc(numbers[i]) != numbers[i]) return std::nullopt;
  }
  if (numbers[0] < 0 || numbers[1] < 0) return std::nullopt;
  return SwcRow{cells[0], cells[6], numbers[6] < 0 || cells[0] == cells[6]};
}

}  // namespace isofield
