// Which of a mesh's triangles are near a point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "engine/mesh/triangle.h"

namespace isofield::engine {

// A tree of boxes over the triangles along a space-filling curve. Refers to what it is made from. One thread.
class TriangleTree {
 public:
  TriangleTree(std::span<const float> positions, std::span<const Triangle> triangles);

  // A triangle within `distance` of p that faces along `facing`, which need not be a unit vector: by an angle with more
  // than this cosine, >= 0. Nothing where there is none. Quick where the one found last will do.
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
  std::size_t leaves_ = 1;     // a power of 2
  std::size_t last_leaf_ = 0;  // of what was found last
  std::vector<Box> boxes_;     // of node i >= 1, whose children are 2 i and 2 i + 1; leaves come last
};

}  // namespace isofield::engine
