// The bricks of a lattice as an octree, walked along rays from front to back: the cost of a ray follows the bricks that
// it meets.
#pragma once

#include <cstdint>
#include <vector>

#include "blobtree/cull/lattice.h"

namespace isofield::blobtree {

// Points origin + t direction.
struct Ray {
  dvec3 origin, direction;

  dvec3 point(double t) const { return origin + direction * t; }
};

// A stretch of a ray.
struct RaySpan {
  double begin, end;

  bool empty() const { return !(begin < end); }
};

// The part of a ray's `within` that lies in the box; empty where it misses the box. A ray along a face of two boxes
// lies in the upper one.
RaySpan clip(const Ray& ray, const Box& box, RaySpan within);

// Immutable once constructed: any number of threads may walk at once.
class BrickTree {
 public:
  BrickTree() = default;
  // `bricks` in Morton order, as cull() returns them.
  BrickTree(const Lattice& lattice, const std::vector<Brick>& bricks);

  // Appends the stretches of `within` that lie in bricks, in their order and those that touch joined, until they are of
  // `most` bricks. Returns how many bricks they are of; fewer than `most` only at the end of `within`.
  std::size_t walk(const Ray& ray, RaySpan within, std::size_t most, std::vector<RaySpan>& spans) const;

  std::size_t brick_count() const { return brick_count_; }

 private:
  struct Node {
    std::uint32_t first;    // child, in the level below
    std::uint32_t present;  // bits of the octants x + 2 y + 4 z that have a child
  };
  struct Cell {
    std::uint32_t x, y, z;
  };
  struct Walk;
  bool descend(Walk& walk, std::size_t level, std::uint32_t node, const Cell& cell) const;

  dvec3 origin_, step_;                    // of bricks
  std::vector<std::vector<Node>> levels_;  // [l]: cells of 2^(l + 1) bricks a side; the last is the root alone
  std::size_t brick_count_ = 0;
};

}  // namespace isofield::blobtree
