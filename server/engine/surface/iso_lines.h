// Finds the level curves of a function that is sampled on a plane, by marching squares, and joins them to polylines.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isofield::engine {

// Lines in the coordinates of the samples: sample (i, j) lies at (i, j).
struct Polylines {
  std::vector<float> points;          // 2 a point
  std::vector<std::uint32_t> starts;  // first point of each line, and the number of points; {0} where there is no line
};

// Returns the lines along which a function with `values` at (i, j), i fastest, has the value `level`; greater values
// lie on their left. Points lie on the edges between samples, by linear interpolation. If two opposite corners of a
// square are above the level, the mean of its four values decides whether they are joined. A closed line ends with its
// first point; other lines end at the border.
Polylines iso_lines(std::span<const float> values, std::array<std::uint32_t, 2> counts, float level);

}  // namespace isofield::engine
