// Reads numbers from the rows of tables.
#pragma once

#include <absl/status/status.h>
#include <absl/strings/string_view.h>

#include <cstddef>
#include <vector>

#include "tables/cells.h"
#include "tables/column_names.h"

namespace isofield {

// Reads the numbers in some columns of the rows of a table, without parsing the other columns. Any number of threads
// may call parse() at the same time.
class RowNumbers {
 public:
  // `places` has the index of the column of each number that parse() returns; no column is there twice. `names` has the
  // names of all columns. It is empty where there is no header; then a row may have further columns after the last of
  // the places.
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
  // The index of the number that each column holds, or kIgnored, for the columns up to the last one that is wanted.
  std::vector<int> number_of_;
  // True where the wanted numbers are the first columns, in their order.
  bool is_plain_ = true;
};

}  // namespace isofield
