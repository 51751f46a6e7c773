#include "plot/region_outline.h"

#include <glm/geometric.hpp>
#include <utility>

namespace isofield {
namespace {

constexpr int kRounds = 3;
constexpr int kParts = 16;  // parts into which each round cuts an interval
// The least length of a segment, in cells. Shorter ones surround a single lattice point that the region touches.
constexpr double kLeastLength = 0.02;

// A lattice edge, in lattice coordinates, that leads from outside (t = low) to inside (t = high).
struct Crossing {
  Point from{}, to{};
  double low = 0, high = 1;

  Point at(double t) const { return from + t * (to - from); }
};

}  // namespace

absl::StatusOr<std::vector<Segment>> region_outline(double low, double high, int cells, const Membership& contains) {
  const int side = cells + 1;
  const double step = (high - low) / cells;
  const auto placed = [&](const Point& p) { return low + step * p; };
  std::vector<Point> points;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) points.push_back(placed({double(i), double(j)}));
  }
  const auto inside = contains(points);
  if (!inside.ok()) return inside.status();
  const auto index = [&](int i, int j) { return static_cast<std::size_t>(j) * side + i; };

  // Each lattice point has two edges: the one along x, then the one along y.
  std::vector<Crossing> crossings;
  std::vector<int> crossing_of(2 * points.size(), -1);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      for (int axis = 0; axis < 2; ++axis) {
        const int i1 = i + (axis == 0), j1 = j + (axis == 1);
        if (i1 == side || j1 == side) continue;
        const bool a = (*inside)[index(i, j)] != 0, b = (*inside)[index(i1, j1)] != 0;
        if (a == b) continue;
        crossing_of[2 * index(i, j) + axis] = static_cast<int>(crossings.size());
        const Point first{double(i), double(j)}, second{double(i1), double(j1)};
        crossings.push_back(a ? Crossing{second, first} : Crossing{first, second});
      }
    }
  }
  for (int round = 0; round < kRounds && !crossings.empty(); ++round) {
    points.clear();
    for (const Crossing& c : crossings) {
      for (int part = 1; part < kParts; ++part)
        points.push_back(placed(c.at(c.low + (c.high - c.low) * part / kParts)));
    }
    const auto within = contains(points);
    if (!within.ok()) return within.status();
    for (std::size_t n = 0; n < crossings.size(); ++n) {
      Crossing& c = crossings[n];
      int part = 1;
      while (part < kParts && !(*within)[n * (kParts - 1) + part - 1]) ++part;
      const double width = (c.high - c.low) / kParts;
      c.low += (part - 1) * width;
      c.high = c.low + width;
    }
  }

  std::vector<Segment> outline;
  const auto end = [&](int crossing) { return crossings[crossing].at(crossings[crossing].high); };
  const auto length = [&](int a, int b) { return glm::distance(end(a), end(b)); };
  const auto join = [&](int a, int b) {
    if (length(a, b) >= kLeastLength) outline.push_back({placed(end(a)), placed(end(b))});
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      int ends[4], count = 0;
      for (const int crossing : {crossing_of[2 * index(i, j)], crossing_of[2 * index(i + 1, j) + 1],
                                 crossing_of[2 * index(i, j + 1)], crossing_of[2 * index(i, j) + 1]}) {
        if (crossing >= 0) ends[count++] = crossing;
      }
      if (count == 0) continue;
      // Four ends are joined in the pairs that are nearer to each other.
      if (count == 4 &&
          length(ends[1], ends[2]) + length(ends[3], ends[0]) < length(ends[0], ends[1]) + length(ends[2], ends[3])) {
        std::swap(ends[0], ends[2]);
      }
      join(ends[0], ends[1]);
      if (count == 4) join(ends[2], ends[3]);
    }
  }
  return outline;
}

}  // namespace isofield
