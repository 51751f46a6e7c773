#include "engine/simplify/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace isofield::engine {
namespace {

using blobtree::dvec3;

constexpr std::size_t kLeafTriangles = 4;
// The next search looks first below the node that lies this many levels above the leaf of the triangle found last.
constexpr int kLevelsBeside = 8;
constexpr float kFar = std::numeric_limits<float>::max();

// Returns the lower 21 bits of x, with two zeros between them.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

// Returns true if the squared distance of p from the triangle a b c, whose normal is n, is at most `limit`. Seen along
// n, either p lies over the triangle, or an edge is the nearest part of it.
bool is_near(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& n, double limit) {
  const double height = dot(p - a, n);
  if (height * height > limit * dot(n, n)) return false;
  bool is_over = true;
  const auto is_near_edge = [&](const dvec3& from, const dvec3& to) {
    const dvec3 edge = to - from, q = p - from;
    if (dot(cross(edge, q), n) >= 0) return false;
    is_over = false;
    const dvec3 off = q - edge * std::clamp(dot(q, edge) / dot(edge, edge), 0.0, 1.0);
    return dot(off, off) <= limit;
  };
  return is_near_edge(a, b) || is_near_edge(b, c) || is_near_edge(c, a) || is_over;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const float> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
  Box all{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const auto add = [&](Box& box, std::uint32_t vertex) {
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], positions[3 * std::size_t{vertex} + a]);
      box.high[a] = std::max(box.high[a], positions[3 * std::size_t{vertex} + a]);
    }
  };
  for (const Triangle& t : triangles) add(all, t[0]);
  const double edge = std::max({all.high[0] - all.low[0], all.high[1] - all.low[1], all.high[2] - all.low[2], 1e-30f});
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    std::uint64_t code = 0;
    for (int a = 0; a < 3; ++a) {
      const double at = (positions[3 * std::size_t{triangles[t][0]} + a] - all.low[a]) / edge;
      code |= spread(static_cast<std::uint64_t>(at * 0x1fffff)) << a;
    }
    places[t] = {code, t};
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 0; i < places.size(); ++i) order_[i] = places[i].second;

  leaves_ = std::bit_ceil(std::max<std::size_t>((triangles.size() + kLeafTriangles - 1) / kLeafTriangles, 1));
  boxes_.assign(2 * leaves_, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  for (std::size_t i = 0; i < order_.size(); ++i) {
    for (const std::uint32_t v : triangles[order_[i]]) add(boxes_[leaves_ + i / kLeafTriangles], v);
  }
  for (std::size_t node = leaves_ - 1; node >= 1; --node) {
    const Box &l = boxes_[2 * node], &r = boxes_[2 * node + 1];
    for (int a = 0; a < 3; ++a) {
      boxes_[node].low[a] = std::min(l.low[a], r.low[a]);
      boxes_[node].high[a] = std::max(l.high[a], r.high[a]);
    }
  }
}

std::optional<std::uint32_t> TriangleTree::find(const dvec3& p, const dvec3& facing, double cosine, double distance) {
  const Wanted wanted{p, facing, cosine * cosine * dot(facing, facing), distance * distance};
  if (const auto found = find_in_leaf(last_leaf_, wanted)) return found;
  // Consecutive points lie near each other, and so mostly do their triangles.
  const std::size_t beside = (leaves_ + last_leaf_) >> kLevelsBeside;
  if (beside > 1) {
    if (const auto found = find_below(beside, wanted)) return found;
  }
  return find_below(1, wanted);
}

std::optional<std::uint32_t> TriangleTree::find_below(std::size_t top, const Wanted& wanted) {
  const auto distance2 = [&](const Box& box) {
    const auto off = [](float low, float high, double x) { return std::max(std::max(low - x, x - high), 0.0); };
    const dvec3 d{off(box.low[0], box.high[0], wanted.p.x), off(box.low[1], box.high[1], wanted.p.y),
                  off(box.low[2], box.high[2], wanted.p.z)};
    return dot(d, d);
  };
  // The nearer of two children is searched first, since it is likely to end the search.
  std::array<std::size_t, 64> stack;
  std::size_t depth = 0;
  if (distance2(boxes_[top]) <= wanted.distance2) stack[depth++] = top;
  while (depth > 0) {
    const std::size_t node = stack[--depth];
    if (node < leaves_) {
      std::size_t near = 2 * node, far = near + 1;
      double to_near = distance2(boxes_[near]), to_far = distance2(boxes_[far]);
      if (to_far < to_near) std::swap(near, far), std::swap(to_near, to_far);
      if (to_far <= wanted.distance2) stack[depth++] = far;
      if (to_near <= wanted.distance2) stack[depth++] = near;
    } else if (const auto found = find_in_leaf(node - leaves_, wanted)) {
      last_leaf_ = node - leaves_;
      return found;
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> TriangleTree::find_in_leaf(std::size_t leaf, const Wanted& wanted) const {
  const std::size_t first = leaf * kLeafTriangles;
  for (std::size_t i = first; i < std::min(first + kLeafTriangles, order_.size()); ++i) {
    const Triangle& t = triangles_[order_[i]];
    const dvec3 a = position_of(positions_, t[0]), b = position_of(positions_, t[1]), c = position_of(positions_, t[2]);
    const dvec3 n = cross(b - a, c - a);
    const double along = dot(n, wanted.facing);
    if (along > 0 && along * along > wanted.cosine2 * dot(n, n) && is_near(wanted.p, a, b, c, n, wanted.distance2)) {
      return order_[i];
    }
  }
  return std::nullopt;
}

}  // namespace isofield::engine
