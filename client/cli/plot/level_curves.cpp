#include "plot/level_curves.h"

namespace isofield {

std::vector<Segment> level_curve(std::span<const float> values, int side, float level) {
  const auto at = [&](int i, int j) { return values[std::size_t{1} * j * side + i] - level; };
  // Returns the point between two neighbouring samples, one on each side of the level, at which the level is crossed.
  const auto crossing = [&](int i0, int j0, int i1, int j1) {
    const double a = at(i0, j0), b = at(i1, j1), t = a / (a - b);
    return Point{i0 + t * (i1 - i0), j0 + t * (j1 - j0)};
  };
  std::vector<Segment> segments;
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      const int corners[5][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}, {i, j}};
      Point ends[4];
      int count = 0;
      for (int edge = 0; edge < 4; ++edge) {
        const auto& [i0, j0] = corners[edge];
        const auto& [i1, j1] = corners[edge + 1];
        if ((at(i0, j0) < 0) != (at(i1, j1) < 0)) ends[count++] = crossing(i0, j0, i1, j1);
      }
      if (count >= 2) segments.push_back({ends[0], ends[1]});
      if (count == 4) segments.push_back({ends[2], ends[3]});
    }
  }
  return segments;
}

}  // namespace isofield
