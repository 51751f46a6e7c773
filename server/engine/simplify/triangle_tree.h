// TriangleTree finds a triangle of a mesh that is near a point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {

// A tree of boxes over the triangles, which it sorts along a space-filling curve. It refers to the data that it is made
// from, which must outlive it. Belongs to one thread.
class TriangleTree {
 public:
  TriangleTree(std::span<const float> positions, std::span<const Triangle> triangles);

  // Returns a triangle within `distance` of p whose normal and `facing` have an angle of more than this cosine (>= 0),
  // or nothing if there is none. `facing` need not be a unit vector. The search is quick if the triangle lies near the
  // one found last.
  std::optional<std::uint32_t> find(const blobtree::dvec3& p, const blobtree::dvec3& facing, double cosine,
                                    double distance);

 private:
  struct Box {
    std::array<float, 3> low, high;
  };
  struct Wanted {
    blobtree::dvec3 p, facing;
    double cosine2, distance2;
  };
  std::optional<std::uint32_t> find_below(std::size_t node, const Wanted& wanted);
  std::optional<std::uint32_t> find_in_leaf(std::size_t leaf, const Wanted& wanted) const;

  std::span<const float> positions_;
  std::span<const Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::size_t leaves_ = 1;     // the number of leaves of the tree, a power of 2
  std::size_t last_leaf_ = 0;  // the leaf of the triangle that was found last
  std::vector<Box> boxes_;     // the boxes of nodes i >= 1; the children of i are 2 i and 2 i + 1; leaves come last
};

}  // namespace isofield::engine
