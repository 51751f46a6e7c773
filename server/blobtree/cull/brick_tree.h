// BrickTree holds the bricks of a lattice as an octree and walks them along rays from front to back. The cost of a ray
// grows with the bricks that it meets, and not with the lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/cull/lattice.h"

namespace isofield::blobtree {

// A Ray is the points origin + t direction.
struct Ray {
  dvec3 origin, direction;

  dvec3 point(double t) const { return origin + direction * t; }
};

// A RaySpan is the stretch of a ray from t = begin to t = end.
struct RaySpan {
  double begin, end;

  bool empty() const { return !(begin < end); }
};

// Returns the part of a ray's `within` that lies in the box, or an empty span if the ray misses the box. A ray along a
// face of two boxes lies in the upper one.
RaySpan clip(const Ray& ray, const Box& box, RaySpan within);

// A tree is immutable once constructed, so that any number of threads may walk it at once.
class BrickTree {
 public:
  BrickTree() = default;
  // `bricks` are in Morton order, as cull() returns them.
  BrickTree(const Lattice& lattice, const std::vector<Brick>& bricks);

  // Appends the stretches of `within` that lie in bricks, in their order along the ray, until `most` bricks are met.
  // Stretches that touch are joined. Returns how many bricks are met, which is less than `most` only at the end of
  // `within`.
  std::size_t walk(const Ray& ray, RaySpan within, std::size_t most, std::vector<RaySpan>& spans) const;

  std::size_t brick_count() const { return brick_count_; }

 private:
  struct Node {
    std::uint32_t first;    // place of the first child in the level below
    std::uint32_t present;  // bits of the octants x + 2 y + 4 z that have a child
  };
  struct Cell {
    std::uint32_t x, y, z;
  };
  struct Walk;
  bool descend(Walk& walk, std::size_t level, std::uint32_t node, const Cell& cell) const;

  dvec3 origin_, step_;                    // origin of the lattice, and size of a brick
  std::vector<std::vector<Node>> levels_;  // [l] has cells of 2^(l + 1) bricks a side; the last one is the root alone
  std::size_t brick_count_ = 0;
};

}  // namespace isofield::blobtree
