#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace isofield {

// The column whose infinite values mark rays that hit nothing.
inline constexpr char kDistanceColumn[] = "distance";

// What PointReader::notes() says of columns without names, of which the first three are read.
std::string unnamed_columns_note(std::size_t columns);

// The notes of a file: `note` unless it is empty, and the number of rows that were left out because their rays hit
// nothing.
std::vector<std::string> point_notes(const std::string& file, const std::string& note, std::size_t missed);

}  // namespace isofield
