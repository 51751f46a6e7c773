#include "engine/mesh/crease_wedges.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/mesh/disjoint_sets.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

constexpr double kCosine = 0.9063077870366499;  // 25 degrees
// Height by longest edge. Vertices lie up to 4e-3 of a cell off the surface, and so this turns by 4 degrees at most.
constexpr double kThin = 0.06;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Of the side that begins at each corner, the corner at which its opposite begins.
std::vector<std::uint32_t> find_twins(std::span<const std::uint32_t> corners, std::size_t vertices) {
  // Sides by the lower of their vertices.
  std::vector<std::uint32_t> starts(vertices + 1), sides(corners.size()), twins(corners.size(), kNone);
  const auto low = [&](std::uint32_t c) { return std::min(corners[c], corners[next_corner(c)]); };
  const auto high = [&](std::uint32_t c) { return std::max(corners[c], corners[next_corner(c)]); };
  for (std::uint32_t c = 0; c < corners.size(); ++c) ++starts[low(c) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> at(starts.begin(), starts.end() - 1);
  for (std::uint32_t c = 0; c < corners.size(); ++c) sides[at[low(c)]++] = c;
  for (std::uint32_t c = 0; c < corners.size(); ++c) {
    for (std::uint32_t i = starts[low(c)]; i < starts[low(c) + 1] && twins[c] == kNone; ++i) {
      const std::uint32_t d = sides[i];
      if (high(d) == high(c) && corners[d] != corners[c]) twins[c] = d;
    }
  }
  return twins;
}

std::vector<dvec3> face_directions(std::span<const float> positions, std::span<const std::uint32_t> corners,
                                   std::span<const std::uint32_t> twins) {
  const std::size_t count = corners.size() / 3;
  std::vector<dvec3> own(count);
  std::vector<std::uint32_t> beside(count, kNone);  // of thin ones
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
    if (size < kThin * longest * longest && twins[side] != kNone) beside[t] = twins[side] / 3;
  }
  std::vector<dvec3> directions(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::uint32_t from = t;
    for (int step = 0; step < 4 && beside[from] != kNone; ++step) from = beside[from];
    directions[t] = own[beside[from] == kNone ? from : t];
  }
  return directions;
}

}  // namespace

CreaseWedges crease_wedges(const Mesh& mesh) {
  const auto corner_count = static_cast<std::uint32_t>(mesh.triangles.size());
  const std::vector<std::uint32_t> twins = find_twins(mesh.triangles, mesh.positions.size() / 3);
  const std::vector<dvec3> directions = face_directions(mesh.positions, mesh.triangles, twins);
  DisjointSets corners(corner_count);  // that smooth edges join
  for (std::uint32_t c = 0; c < corner_count; ++c) {
    const std::uint32_t d = twins[c];
    if (d == kNone || d < c || dot(directions[c / 3], directions[d / 3]) <= kCosine) continue;
    corners.join(c, next_corner(d));
    corners.join(next_corner(c), d);
  }
  CreaseWedges wedges;
  wedges.vertices.resize(mesh.positions.size() / 3);
  std::iota(wedges.vertices.begin(), wedges.vertices.end(), 0u);
  std::vector<bool> is_taken(wedges.vertices.size());
  std::vector<std::uint32_t> wedge_of(corner_count);
  wedges.triangles.resize(corner_count / 3);
  for (std::uint32_t c = 0; c < corner_count; ++c) {
    const std::uint32_t vertex = mesh.triangles[c];
    if (const std::uint32_t first = corners.root(c); first != c) {
      wedge_of[c] = wedge_of[first];
    } else if (!is_taken[vertex]) {
      is_taken[vertex] = true;
      wedge_of[c] = vertex;
    } else {
      wedge_of[c] = static_cast<std::uint32_t>(wedges.vertices.size());
      wedges.vertices.push_back(vertex);
    }
    wedges.triangles[c / 3][c % 3] = wedge_of[c];
  }
  return wedges;
}

}  // namespace isofield::engine
