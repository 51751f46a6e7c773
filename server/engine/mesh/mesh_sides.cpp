#include "engine/mesh/mesh_sides.h"

#include <algorithm>
#include <numeric>

#include "engine/mesh/triangle.h"

namespace isofield::engine {
namespace {

// A triangle is thin if its height is less than this part of its longest edge. Vertices lie up to 4e-3 of a cell off
// the surface, which turns thicker triangles by 4 degrees at most.
constexpr double kThin = 0.06;

}  // namespace

std::vector<std::uint32_t> find_twins(std::span<const std::uint32_t> corners, std::size_t vertices) {
  // The half-edges are listed by the lower of their two vertices.
  std::vector<std::uint32_t> starts(vertices + 1), sides(corners.size()), twins(corners.size(), kNoTwin);
  const auto low = [&](std::uint32_t c) { return std::min(corners[c], corners[next_corner(c)]); };
  const auto high = [&](std::uint32_t c) { return std::max(corners[c], corners[next_corner(c)]); };
  for (std::uint32_t c = 0; c < corners.size(); ++c) ++starts[low(c) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> at(starts.begin(), starts.end() - 1);
  for (std::uint32_t c = 0; c < corners.size(); ++c) sides[at[low(c)]++] = c;
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    for (std::uint32_t i = starts[low(c)]; i < starts[low(c) + 1] && twins[c] == kNoTwin; ++i) {
      const std::uint32_t d = sides[i];
      if (high(d) == high(c) && corners[d] != corners[c]) twins[c] = d;
    }
  }
  return twins;
}

std::vector<blobtree::dvec3> face_directions(std::span<const float> positions, std::span<const std::uint32_t> corners,
                                             std::span<const std::uint32_t> twins) {
  using blobtree::dvec3;
  const std::size_t count = corners.size() / 3;
  std::vector<dvec3> own(count);
  std::vector<std::uint32_t> beside(count, kNoTwin);  // for thin triangles: the triangle at the longest edge
  for (std::uint32_t t = 0; t < count; ++t) {
    const dvec3 n = normal_of(positions, {corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]});
    double longest = 0;
    std::uint32_t side = 0;
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
      const double edge = length(position_of(positions, corners[next_corner(c)]) - position_of(positions, corners[c]));
      if (edge > longest) longest = edge, side = c;
    }
    const double size = length(n);
    if (size > 0) own[t] = n * (1 / size);
    if (size < kThin * longest * longest && twins[side] != kNoTwin) beside[t] = twins[side] / 3;
  }
  std::vector<dvec3> directions(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::uint32_t from = t;
    for (int step = 0; step < 4 && beside[from] != kNoTwin; ++step) from = beside[from];
    directions[t] = own[beside[from] == kNoTwin ? from : t];
  }
  return directions;
}

}  // namespace isofield::engine
