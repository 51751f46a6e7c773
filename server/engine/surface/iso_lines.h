// Level curves of a function that is sampled on a plane: marching squares, joined to polylines.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isofield::engine {

// In the samples' coordinates: sample (i, j) lies at (i, j).
struct Polylines {
  std::vector<float> points;          // 2 a point
  std::vector<std::uint32_t> starts;  // first point of each line, and the number of points; {0} where there is no line
};

// Where a function with `values` at (i, j), i fastest, has the value `level`: greater values lie on the left. Points
// lie on the edges between samples, by linear interpolation; in a square with two opposite corners above, the mean of
// the four decides whether they are joined. A closed line ends with its first point, others end at the border.
Polylines iso_lines(std::span<const float> values, std::array<std::uint32_t, 2> counts, float level);

}  // namespace isofield::engine
