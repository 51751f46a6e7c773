#include "blobtree/cull/brick_tree.h"

#include <algorithm>
#include <bit>

namespace isofield::blobtree {
namespace {

// Returns false if the ray runs parallel to the slab and outside of it.
bool clip_axis(double origin, double direction, double low, double high, RaySpan& span) {
  if (direction == 0) return low <= origin && origin < high;
  const double a = (low - origin) / direction, b = (high - origin) / direction;
  span.begin = std::max(span.begin, std::min(a, b));
  span.end = std::min(span.end, std::max(a, b));
  return true;
}

}  // namespace

RaySpan clip(const Ray& ray, const Box& box, RaySpan within) {
  const dvec3 &o = ray.origin, &d = ray.direction;
  const bool meets = clip_axis(o.x, d.x, box.min.x, box.max.x, within) &&
                     clip_axis(o.y, d.y, box.min.y, box.max.y, within) &&
                     clip_axis(o.z, d.z, box.min.z, box.max.z, within);
  return meets ? within : RaySpan{0, 0};
}

BrickTree::BrickTree(const Lattice& lattice, const std::vector<Brick>& bricks)
    : origin_(lattice.origin), step_(lattice.spacing * double{kBrickCells}), brick_count_(bricks.size()) {
  std::vector<Cell> cells;
  cells.reserve(bricks.size());
  for (const Brick& b : bricks) cells.push_back({b.x, b.y, b.z});
  const auto is_origin = [](const Cell& c) { return c.x == 0 && c.y == 0 && c.z == 0; };
  while (!cells.empty() && (levels_.empty() || cells.size() > 1 || !is_origin(cells[0]))) {
    std::vector<Node> nodes;
    std::vector<Cell> parents;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      const Cell& c = cells[i];
      const Cell parent{c.x >> 1, c.y >> 1, c.z >> 1};
      const bool is_new = parents.empty() || parents.back().x != parent.x || parents.back().y != parent.y ||
                          parents.back().z != parent.z;
      if (is_new) {
        parents.push_back(parent);
        nodes.push_back({i, 0});
      }
      nodes.back().present |= 1u << ((c.x & 1) | (c.y & 1) << 1 | (c.z & 1) << 2);
    }
    levels_.push_back(std::move(nodes));
    cells = std::move(parents);
  }
}

struct BrickTree::Walk {
  const Ray& ray;
  const RaySpan within;
  const std::uint32_t nearest;  // the octant that the ray meets first, if it meets all
  const std::size_t most;
  std::vector<RaySpan>& spans;
  std::size_t bricks = 0;
};

std::size_t BrickTree::walk(const Ray& ray, RaySpan within, std::size_t most, std::vector<RaySpan>& spans) const {
  if (levels_.empty() || within.empty()) return 0;
  const dvec3& d = ray.direction;
  const std::uint32_t nearest = (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
  Walk walk{ray, within, nearest, most, spans};
  descend(walk, levels_.size() - 1, 0, {0, 0, 0});
  return walk.bricks;
}

// Returns false when enough bricks are met. The recursion is as deep as the tree, which has 22 levels at most.
bool BrickTree::descend(Walk& walk, std::size_t level, std::uint32_t node, const Cell& cell) const {
  const Node& n = levels_[level][node];
  const auto side = static_cast<double>(std::uint64_t{1} << level);
  // If a ray meets two octants, the one that differs from `nearest` in a subset of the other's axes comes first.
  for (std::uint32_t o = 0; o < 8; ++o) {
    const std::uint32_t octant = o ^ walk.nearest;
    if ((n.present >> octant & 1) == 0) continue;
    const Cell c{2 * cell.x + (octant & 1), 2 * cell.y + (octant >> 1 & 1), 2 * cell.z + (octant >> 2)};
    // Neighbours compute the plane between them from the same numbers, so that the stretches in them touch exactly.
    const Box box{
        {origin_.x + step_.x * (side * c.x), origin_.y + step_.y * (side * c.y), origin_.z + step_.z * (side * c.z)},
        {origin_.x + step_.x * (side * (c.x + 1.0)), origin_.y + step_.y * (side * (c.y + 1.0)),
         origin_.z + step_.z * (side * (c.z + 1.0))}};
    const RaySpan span = clip(walk.ray, box, walk.within);
    if (span.empty()) continue;
    if (level > 0) {
      const auto place = static_cast<std::uint32_t>(std::popcount(n.present & ((1u << octant) - 1)));
      if (!descend(walk, level - 1, n.first + place, c)) return false;
      continue;
    }
    if (walk.bricks > 0 && walk.spans.back().end == span.begin) {
      walk.spans.back().end = span.end;
    } else {
      walk.spans.push_back(span);
    }
    if (++walk.bricks == walk.most) return false;
  }
  return true;
}

}  // namespace isofield::blobtree
