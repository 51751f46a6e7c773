#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "blobtree/primitives/leaf.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::Random;
using test_support::read_or_die;
using test_support::scene_of_nodes;

// Returns the one leaf of a scene of one node.
Leaf leaf_of(const std::string& node) {
  return compile_or_die(read_or_die(scene_of_nodes(node))).leaves.at(0);
}

TEST(LeafBounds, HoldAtRandomPointsOfRandomBoxes) {
  double width = 0, of_balls = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 30})));
    Random random(seed);
    for (const Leaf& leaf : tape.leaves) {
      for (int n = 0; n < 4; ++n) {
        dvec3 centre = random.point(-1.6, 1.6);
        // Some boxes lie on the skeleton, where the distance has no gradient.
        if (leaf.operand == Operand::kSegment && n == 0) {
          const double along = std::get<shapes::Segment>(leaf.shape).length * random.number(-0.1, 1.1);
          centre = leaf.domain.anchor + leaf.domain.to_local.linear[2] * along;
        }
        const double size = std::exp(random.number(-6, 0.5));
        const dvec3 half = random.point(0, size);
        const CentredBox box(Box{centre - half, centre + half});
        const Interval bounds = distance_bounds(leaf, box);
        for (int i = 0; i < 16; ++i) {
          // The greatest distances are at corners.
          const auto side = [&](int axis) { return i < 8 ? (i >> axis & 1) * 2.0 - 1 : random.number(-1, 1); };
          const dvec3 p = box.centre + dvec3{box.half.x * side(0), box.half.y * side(1), box.half.z * side(2)};
          ASSERT_GE(leaf.distance(p), bounds.lo) << "seed " << seed << " leaf " << leaf.node;
          ASSERT_LE(leaf.distance(p), bounds.hi) << "seed " << seed << " leaf " << leaf.node;
        }
        if (leaf.operand == Operand::kSphere || leaf.operand == Operand::kSegment) {
          width += bounds.hi - bounds.lo;
          of_balls += 2 * box.radius;
        }
      }
    }
  }
  std::printf("spheres and segments: %.2f of the width that the balls around the boxes give\n", width / of_balls);
  EXPECT_LT(width, 0.85 * of_balls);
}

TEST(LeafBounds, OfSpheresAreReached) {
  const Leaf leaf = leaf_of(R"({"sphere": {"center": [1, 0, 0], "radius": 0.5, "range": 1}})");
  const Interval beside = distance_bounds(leaf, CentredBox({{2, 1, 1}, {3, 2, 2}}));
  EXPECT_NEAR(beside.lo, std::sqrt(3) - 0.5, 1e-5);
  EXPECT_NEAR(beside.hi, std::sqrt(12) - 0.5, 1e-5);
  const Interval around = distance_bounds(leaf, CentredBox({{0, -1, -1}, {2, 1, 1}}));
  EXPECT_NEAR(around.lo, -0.5, 1e-5);
  EXPECT_NEAR(around.hi, std::sqrt(3) - 0.5, 1e-5);
}

TEST(LeafBounds, OfRoundConesFollowTheirNormal) {
  // The box lies beside a cone of a tilt with sine 0.6, whose normal there is (0.8, 0, 0.6).
  const Leaf leaf = leaf_of(R"({"segment": {"a": [0,0,0], "b": [0,0,10], "radius_a": 7, "radius_b": 1, "range": 1}})");
  const dvec3 p = dvec3{0, 0, 5} + dvec3{0.8, 0, 0.6} * 6.0;
  const double h = 0.01;
  const Interval bounds = distance_bounds(leaf, CentredBox({p - dvec3{h, h, h}, p + dvec3{h, h, h}}));
  EXPECT_NEAR(leaf.distance(p), 2, 1e-12);
  EXPECT_NEAR(bounds.lo, 2 - 1.4 * h, 2e-4);
  EXPECT_NEAR(bounds.hi, 2 + 1.4 * h, 2e-4);
}

}  // namespace
}  // namespace isofield::blobtree
