// Finds the header of a table, its separator and its first row.
#pragma once

#include <absl/strings/string_view.h>

#include <string>

#include "tables/cells.h"
#include "tables/column_names.h"

namespace isofield {

// Returns true for lines that hold nothing: blank ones, and those that begin with '#', '%' or "//".
bool is_comment(absl::string_view line);

// Reads the lines before the first row of a table, which may state the names of the columns and the separator. It takes
// line after line until the first row comes.
//  - A first line that begins with no number is a header, with the names of the columns.
//  - The last comment before the first row is a header too, where it names x, y and z and has a name for each cell of
//    that row: "# x y z", "//X Y Z".
//  - A line "sep=;" before these, which spreadsheets write, is skipped.
class TableHead {
 public:
  // Returns false where `line` is not a row. Returns true where `line` is the first row: everything is then known, and
  // this must not be called again.
  bool take(absl::string_view line);

  // The names of the columns; there are none where there is no header.
  const ColumnNames& names() const { return names_; }
  Separator separator() const { return separator_; }
  // The number of cells in the first row. An empty cell after a separator at the line's end does not count.
  std::size_t columns() const { return columns_; }

 private:
  void set_names(absl::string_view line, Separator separator);

  ColumnNames names_;
  bool has_names_ = false;
  Separator separator_ = kBlanks;
  std::size_t columns_ = 0;
  std::string comment_;
};

}  // namespace isofield
