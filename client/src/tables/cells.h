// Splits the lines of tables into cells.
#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace isofield {

// The character that separates the cells of a line: ';', ',' or a tab, each of which ends one cell; or kBlanks.
using Separator = char;
// kBlanks means that any run of blanks, tabs, commas and semicolons separates two cells. In a line that also has
// blanks, a comma between digits is refused, since it could be a decimal comma.
inline constexpr Separator kBlanks = ' ';

// Guesses the separator of a line. Characters within double quotes do not count.
Separator find_separator(absl::string_view line);

// Returns the cells of a line without blanks around them and without their double quotes (RFC 4180). A separator at the
// end of the line is followed by an empty cell, except for kBlanks.
std::vector<absl::string_view> split_cells(absl::string_view line, Separator separator);

// Returns the end of the cell that begins at `begin`: the next separator outside of double quotes, or `end`. Not usable
// with kBlanks.
const char* cell_end(const char* begin, const char* end, Separator separator);
// Returns the text of a cell without the blanks and double quotes around it.
absl::string_view bare_cell(absl::string_view cell);

// Returns the number in a bare cell, which may have a decimal comma where semicolons separate the cells. Returns
// nothing where it is no number.
std::optional<double> cell_number(absl::string_view cell, Separator separator);

}  // namespace isofield
