#pragma once

#include <absl/status/status.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <vector>

#include "tables/cells.h"
#include "tables/column_names.h"

namespace isofield {

// Reads the numbers of some columns of a table's rows, without a look at the others.
class RowNumbers {
 public:
  // `places`: the column of each number that parse() returns, all different. `names`: of all columns; empty: there is
  // no header, and a row may have any number of columns from the last of the places on.
  RowNumbers(Separator separator, std::vector<std::size_t> places, ColumnNames names);

  // Writes as many numbers as there are places; they may be infinite or NaN. INVALID_ARGUMENT: a cell is missing or no
  // number, or the row has more or fewer cells than the header; the message begins with "expected".
  absl::Status parse(absl::string_view row, double* numbers) const;

 private:
  bool parse_plain(const char*& at, const char* end, double* numbers) const;
  const char* scan_cell(const char* begin, const char* end, double& value) const;
  absl::Status check_count(const char* at, const char* end, std::size_t column) const;
  absl::Status refuse(absl::string_view row, std::size_t column) const;

  const Separator separator_;
  const ColumnNames names_;
  const std::size_t wanted_;
  // The number that each column holds, or kIgnored; up to the last one that is wanted.
  std::vector<int> number_of_;
  // The numbers are the first columns, in their order.
  bool is_plain_ = true;
};

}  // namespace isofield
