#pragma once

#include <absl/strings/string_view.h>

#include <string>

#include "tables/cells.h"
#include "tables/column_names.h"

namespace isofield {

// True for lines that hold nothing: blank ones, and those that begin with '#', '%' or "//".
bool is_comment(absl::string_view line);

// What the lines before the first row of a table say. Takes line after line until a row comes.
//  - A first line that begins with no number is a header, with the names of the columns.
//  - So is the last comment before the first row, where it names x, y and z and has a name for each cell of that row:
//    "# x y z", "//X Y Z".
//  - "sep=;" before them, which spreadsheets write, is left out.
class TableHead {
 public:
  // False: not a row yet. True: `line` is the first row, and all is known; no further line is to be taken.
  bool take(absl::string_view line);

  // Empty: there is no header.
  const ColumnNames& names() const { return names_; }
  Separator separator() const { return separator_; }
  // Of the first row, without an empty cell that a separator at the line's end makes.
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
