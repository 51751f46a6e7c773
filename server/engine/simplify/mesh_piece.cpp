#include "engine/simplify/mesh_piece.h"

#include <absl/container/flat_hash_map.h>
#include <absl/container/flat_hash_set.h>

#include <algorithm>
#include <numeric>

#include "engine/mesh/disjoint_sets.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;

// A triangle whose height is less than this part of its longest edge is flat.
constexpr double kThin = 0.01;
constexpr int kTurnSweeps = 4;

struct Shape {
  double height;  // the height over the longest edge, as a part of that edge
  int longest;    // the longest edge leads from this corner to the next
};
Shape shape_of(std::span<const float> positions, const Triangle& t) {
  Shape shape{0, 0};
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const dvec3 edge = position_of(positions, t[(i + 1) % 3]) - position_of(positions, t[i]);
    if (dot(edge, edge) > longest) longest = dot(edge, edge), shape.longest = i;
  }
  if (longest > 0) shape.height = length(normal_of(positions, t)) / longest;
  return shape;
}

Triangle rotated(const Triangle& t, int first) {
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

// A half-edge of a triangle, which leads from its corner to the next.
struct Side {
  std::uint64_t edge;
  std::uint32_t corner;
  bool is_rising;
};

// The edges of triangles, and the fans around their vertices.
class Surface {
 public:
  explicit Surface(std::span<const Triangle> triangles) : triangles_(triangles), fan_corners_(3 * triangles.size()) {
    for (std::uint32_t c = 0; c < fan_corners_.size(); ++c) {
      const std::uint32_t from = vertex(c), to = vertex(next_corner(c));
      sides_.push_back({edge_key(from, to), c, from < to});
    }
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.corner < b.corner; });
    for_edges([&](std::span<const Side> uses) {
      ++edges_;
      if (uses.size() != 2 || uses[0].is_rising == uses[1].is_rising) return;
      fan_corners_.join(uses[0].corner, next_corner(uses[1].corner));
      fan_corners_.join(next_corner(uses[0].corner), uses[1].corner);
    });
    for (std::uint32_t c = 0; c < fan_corners_.size(); ++c) {
      int& fans = fans_[vertex(c)];
      fans += fan_corners_.root(c) == c ? 1 : 0;
    }
  }

  // Calls visit(sides) for each edge, with the half-edges that lie on it.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
      end = begin + 1;
      while (end < sides_.size() && sides_[end].edge == sides_[begin].edge) ++end;
      visit(std::span(sides_).subspan(begin, end - begin));
    }
  }
  std::uint32_t vertex(std::uint32_t corner) const { return triangles_[corner / 3][corner % 3]; }
  const absl::flat_hash_map<std::uint32_t, int>& fans() const { return fans_; }
  std::int64_t euler() const {
    return static_cast<std::int64_t>(fans_.size()) - edges_ + static_cast<std::int64_t>(triangles_.size());
  }

 private:
  std::span<const Triangle> triangles_;
  std::vector<Side> sides_;
  DisjointSets fan_corners_;  // joins the corners of one fan
  absl::flat_hash_map<std::uint32_t, int> fans_;
  std::int64_t edges_ = 0;
};

}  // namespace

void turn_flat(std::span<const float> positions, std::vector<Triangle>& triangles) {
  const auto sides = [](const Triangle& t, int i) { return std::uint64_t{t[i]} << 32 | t[(i + 1) % 3]; };
  absl::flat_hash_map<std::uint64_t, std::uint32_t> owners;  // the triangle of each half-edge
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) owners[sides(triangles[t], i)] = t;
  }
  bool has_turned = true;
  for (int sweep = 0; sweep < kTurnSweeps && has_turned; ++sweep) {
    has_turned = false;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Shape shape = shape_of(positions, triangles[t]);
      if (shape.height >= kThin) continue;
      const auto [i, j, k] = rotated(triangles[t], shape.longest);
      const auto other = owners.find(std::uint64_t{j} << 32 | i);
      if (other == owners.end()) continue;
      const std::uint32_t u = other->second;
      const Triangle across = triangles[u];
      const std::uint32_t d = across[0] != i && across[0] != j   ? across[0]
                              : across[1] != i && across[1] != j ? across[1]
                                                                 : across[2];
      const Triangle first{i, d, k}, second{d, j, k};
      const dvec3 facing = normal_of(positions, triangles[t]) + normal_of(positions, across);
      if (d == k || owners.contains(std::uint64_t{d} << 32 | k) || owners.contains(std::uint64_t{k} << 32 | d) ||
          std::min(shape_of(positions, first).height, shape_of(positions, second).height) <= shape.height ||
          dot(normal_of(positions, first), facing) <= 0 || dot(normal_of(positions, second), facing) <= 0) {
        continue;
      }
      owners.erase(std::uint64_t{i} << 32 | j);
      owners.erase(std::uint64_t{j} << 32 | i);
      triangles[t] = first;
      triangles[u] = second;
      for (int n = 0; n < 3; ++n) owners[sides(first, n)] = t, owners[sides(second, n)] = u;
      has_turned = true;
    }
  }
}

MeshEdges::MeshEdges(std::span<const Triangle> triangles, std::size_t vertices) : starts_(vertices + 1) {
  // Each edge of a closed mesh has two half-edges, and exactly one of them leads from the lower vertex to the higher.
  const auto for_rising = [&](const auto& visit) {
    for (const Triangle& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        if (t[i] < t[(i + 1) % 3]) visit(t[i], t[(i + 1) % 3]);
      }
    }
  };
  for_rising([&](std::uint32_t low, std::uint32_t) { ++starts_[low + 1]; });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::uint32_t> at(starts_.begin(), starts_.end() - 1);
  ends_.resize(starts_.back());
  for_rising([&](std::uint32_t low, std::uint32_t high) { ends_[at[low]++] = high; });
}

bool MeshEdges::contains(std::uint64_t edge) const {
  const auto low = static_cast<std::uint32_t>(edge >> 32), high = static_cast<std::uint32_t>(edge);
  const auto begin = ends_.begin() + starts_[low], end = ends_.begin() + starts_[low + 1];
  return std::find(begin, end, high) != end || added_.contains(edge);
}

Fit fit(std::span<const Triangle> before, std::span<const Triangle> after, const MeshEdges& mesh) {
  const Surface old(before), now(after);
  absl::flat_hash_set<std::uint64_t> inner;         // keys of edges
  absl::flat_hash_map<std::uint64_t, bool> border;  // keys of edges; true: the half-edge rises
  absl::flat_hash_set<std::uint32_t> border_vertices;
  old.for_edges([&](std::span<const Side> uses) {
    if (uses.size() > 1) {
      inner.insert(uses[0].edge);
      return;
    }
    border[uses[0].edge] = uses[0].is_rising;
    border_vertices.insert(old.vertex(uses[0].corner));
    border_vertices.insert(old.vertex(next_corner(uses[0].corner)));
  });
  Fit result;
  const auto note = [&](std::uint64_t edge) {
    result.misfits.push_back(static_cast<std::uint32_t>(edge >> 32));
    result.misfits.push_back(static_cast<std::uint32_t>(edge));
  };
  now.for_edges([&](std::span<const Side> uses) {
    const std::uint64_t edge = uses[0].edge;
    const auto at = border.find(edge);
    bool fits = false;
    if (uses.size() == 1) {
      fits = at != border.end() && at->second == uses[0].is_rising;
      if (fits) border.erase(at);
    } else if (uses.size() == 2) {
      fits = uses[0].is_rising != uses[1].is_rising && at == border.end();
      if (fits && !inner.contains(edge) && border_vertices.contains(static_cast<std::uint32_t>(edge >> 32)) &&
          border_vertices.contains(static_cast<std::uint32_t>(edge))) {
        result.chords.push_back(edge);
        fits = !mesh.contains(edge);
      }
    }
    if (!fits) note(edge);
  });
  for (const auto& [edge, is_rising] : border) note(edge);
  for (const auto& [vertex, fans] : now.fans()) {
    const auto at = old.fans().find(vertex);
    if (at == old.fans().end() || at->second != fans) result.misfits.push_back(vertex);
  }
  result.has_same_handles = old.euler() == now.euler();
  return result;
}

}  // namespace isofield::engine
