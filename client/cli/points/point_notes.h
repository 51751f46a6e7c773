#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace isofield {

// The column whose infinite values mark rays that hit nothing.
inline constexpr char kDistanceColumn[] = "distance";

// Returns the note for tables of more than three columns without names, of which the first three are read.
std::string unnamed_columns_note(std::size_t columns);

// Returns the notes of a file: `note`, unless it is empty, and one about the `missed` rows that are left out because
// their rays hit nothing.
std::vector<std::string> point_notes(const std::string& file, const std::string& note, std::size_t missed);

}  // namespace isofield
