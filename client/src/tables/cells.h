#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace isofield {

// What parts the cells of a line: ';', ',' or a tab, each of which is one end of a cell; or kBlanks.
using Separator = char;
// Any run of blanks, tabs, commas and semicolons. A comma between digits is refused where blanks are there too, since
// it could be a decimal comma.
inline constexpr Separator kBlanks = ' ';

// The one that a line seems to be written with; those within double quotes do not count.
Separator find_separator(absl::string_view line);

// The cells of a line without blanks around them and without their double quotes (RFC 4180). A separator at the end of
// the line is followed by an empty cell, but for kBlanks.
std::vector<absl::string_view> split_cells(absl::string_view line, Separator separator);

// The end of the cell that begins at `begin`: the next separator outside of double quotes, or `end`. Not for kBlanks.
const char* cell_end(const char* begin, const char* end, Separator separator);
// Blanks and double quotes at both ends of a cell are no part of its text.
absl::string_view bare_cell(absl::string_view cell);

// The number in a bare cell; it may have a decimal comma where semicolons part the cells. Nothing: it is none.
std::optional<double> cell_number(absl::string_view cell, Separator separator);

}  // namespace isofield
