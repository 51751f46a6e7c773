#include "blobtree/primitives/leaf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "blobtree/primitives/falloff.h"
#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::Random;
using test_support::read_or_die;
using test_support::scene_of_nodes;

double field_of(const Leaf& leaf, const dvec3& p) {
  return soften(leaf.distance(p), leaf.range);
}

// A rotation stretches by 1 up to rounding, and the rounding must not make the least length too short.
TEST(PlaceLeaf, TheLeastLengthIsAcceptedWhateverWayItIsTurned) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    v1::Scene scene;
    v1::Segment& segment = *scene.add_nodes()->mutable_segment();
    for (const double x : {0.0, 0.0, 0.0}) segment.add_a(x);
    const dvec3 b = random.point(-1, 1);
    for (const double x : {b.x, b.y, b.z}) segment.add_b(x);
    segment.set_radius_a(kMinLength);
    segment.set_radius_b(kMinLength);
    segment.set_range(kMinLength);
    const auto read = read_scene(scene, SceneLimits());
    ASSERT_TRUE(read.ok()) << read.status();
    EXPECT_TRUE(compile(*read).ok()) << compile(*read).status();
  }
}

TEST(PlaceLeaf, NothingReachesBeyondTheSupport) {
  double fullest = 0;
  int bounded = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 12})));
    Random random(seed);
    for (const Leaf& leaf : tape.leaves) {
      ASSERT_FALSE(leaf.support.empty());
      const dvec3 size = leaf.support.max - leaf.support.min;
      if (!std::isfinite(length(size))) continue;  // a half-space has no bounds
      ++bounded;
      int inside = 0;
      for (int i = 0; i < 300; ++i) {
        const dvec3 p{leaf.support.min.x + size.x * random.number(-0.2, 1.2),
                      leaf.support.min.y + size.y * random.number(-0.2, 1.2),
                      leaf.support.min.z + size.z * random.number(-0.2, 1.2)};
        const double f = field_of(leaf, p);
        if (!leaf.support.touches({p, p})) {
          ASSERT_EQ(f, 0) << "seed " << seed;
        } else if (f > 0) {
          ++inside;
        }
      }
      fullest = std::max(fullest, inside / 300.0);
      EXPECT_GT(inside, 5) << "seed " << seed << ": the support box is far too large";
    }
  }
  EXPECT_GT(fullest, 0.2);
  EXPECT_GT(bounded, 1000);
}

TEST(PlaceLeaf, SupportsAreTightForPlainShapes) {
  // Each shape touches its box on both sides of every axis, so there is a field just inside of the box's faces.
  for (const char* text :
       {R"({"sphere": {"center": [1,2,3], "radius": 0.5, "range": 0.25}})",
        R"({"ellipsoid": {"semi_axes": [1,0.5,0.25], "range": 0.25}})",
        R"({"box": {"half_size": [1,0.5,0.25], "range": 0.25}})",
        R"({"torus": {"major_radius": 1, "minor_radius": 0.25, "range": 0.25}})",
        R"({"cylinder": {"a": [0,0,-1], "b": [0,0,1], "radius": 0.5, "range": 0.25}})",
        R"({"segment": {"a": [0,0,-1], "b": [0,0,1], "radius_a": 0.5, "radius_b": 0.5, "range": 0.25}})"}) {
    SCOPED_TRACE(text);
    const Leaf leaf = compile_or_die(read_or_die(scene_of_nodes(text))).leaves[0];
    const dvec3 middle = (leaf.support.min + leaf.support.max) * 0.5;
    const bool ring = std::holds_alternative<shapes::Torus>(leaf.shape);
    const dvec3 size = leaf.support.max - leaf.support.min;
    for (const double side : {-0.4999, 0.4999}) {
      EXPECT_GT(field_of(leaf, middle + dvec3{size.x * side, 0, 0}), 0);
      EXPECT_GT(field_of(leaf, middle + dvec3{0, size.y * side, 0}), 0);
      EXPECT_GT(field_of(leaf, middle + dvec3{ring ? 1.0 : 0.0, 0, size.z * side}), 0);
    }
  }
}

TEST(PlaceLeaf, StretchBoundsTheSlopeOfTheDistance) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 12})));
    Random random(seed);
    for (const Leaf& leaf : tape.leaves) {
      for (int i = 0; i < 50; ++i) {
        const dvec3 p = random.point(-3, 3), q = p + random.point(-0.3, 0.3);
        ASSERT_LE(std::abs(leaf.distance(p) - leaf.distance(q)), leaf.domain.stretch * length(p - q) * (1 + 1e-9));
      }
    }
  }
}

TEST(PlaceLeaf, SimilarPlacementsAreRigid) {
  const Tape tape = compile_or_die(read_or_die(scene_of_nodes(
      R"({"segment": {"a": [0,0,0], "b": [1,2,2], "radius_a": 0.5, "radius_b": 0.25, "range": 0.25}},
         {"transform": {"child": "#0", "scale": [3,-3,3], "rotation": [1,2,3,40], "translation": [5,6,7]}})")));
  const Leaf& leaf = tape.leaves[0];
  EXPECT_EQ(leaf.operand, Operand::kSegment);
  EXPECT_EQ(leaf.domain.stretch, 1);
  EXPECT_TRUE(leaf.domain.is_rigid);
  EXPECT_NEAR(std::get<shapes::Segment>(leaf.shape).length, 9, 1e-12);
  EXPECT_NEAR(std::get<shapes::Segment>(leaf.shape).radius_a, 1.5, 1e-12);
  EXPECT_NEAR(leaf.range, 0.75, 1e-12);
  EXPECT_NEAR(leaf.domain.to_local.stretch().least, 1, 1e-12);
  EXPECT_NEAR(leaf.domain.to_local.stretch().most, 1, 1e-12);
}

TEST(PlaceLeaf, UniformScaleMayBeLargeOrSmall) {
  // Only the lengths in the world count. They are 2e-5 and 2e5.
  for (const char* scale : {"1e-5", "1e5"}) {
    const auto scene = read_scene(scene_of_nodes(std::string(R"({"sphere": {"radius": 1, "range": 2}},
      {"transform": {"child": "#0", "scale": [)") +
                                                 scale + "]}}"));
    ASSERT_TRUE(scene.ok());
    const auto tape = compile(*scene);
    EXPECT_TRUE(tape.ok()) << tape.status().message();
  }
}

void expect_refused(const std::string& nodes) {
  const auto scene = read_scene(scene_of_nodes(nodes));
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto tape = compile(*scene);
  ASSERT_FALSE(tape.ok()) << nodes;
  EXPECT_EQ(tape.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(std::string(tape.status().message()).find("nodes[0] 'ball'"), std::string::npos) << tape.status().message();
}

TEST(PlaceLeaf, LengthsThatLeaveTheirRangeAreRefused) {
  const std::string ball = R"({"name": "ball", "sphere": {"radius": 1e3, "range": 1}}, )";
  expect_refused(
      ball + R"({"transform": {"child": "ball", "scale": [1e-5]}}, {"transform": {"child": "#1", "scale": [1e-5]}})");
  expect_refused(ball +
                 R"({"transform": {"child": "ball", "scale": [1e5]}}, {"transform": {"child": "#1", "scale": [1e5]}})");
  // Only the radius leaves its range.
  expect_refused(ball + R"({"transform": {"child": "ball", "scale": [1e7]}})");
  expect_refused(ball + R"({"transform": {"child": "ball", "translation": [9e8,0,0]}},
                           {"transform": {"child": "#1", "translation": [9e8,0,0]}})");
  // Each map is well conditioned, but their product stretches by 1e-10 along one oblique axis.
  expect_refused(ball + R"({"transform": {"child": "ball", "rotation": [1,2,3,40], "scale": [1e-5,1,1]}},
                           {"transform": {"child": "#1", "scale": [1e-5,1,1], "rotation": [1,2,3,40]}},
                           {"transform": {"child": "#2", "rotation": [3,2,3,70], "scale": [1e-5,1,1]}})");
}

TEST(PlaceLeaf, ScalesThatASignedFieldCannotBeDividedByAreRefused) {
  const std::string ball = R"({"name": "ball", "sphere": {"radius": 1, "law": "SIGNED"}}, )";
  // The products leave the range, then float32, and at last the range of doubles.
  for (const char* factor : {"1e-6", "1e6"}) {
    std::string nodes = ball;
    for (int i = 0; i < 60; ++i) {
      nodes += std::string(i > 0 ? ", " : "") + R"({"transform": {"child": "#)" + std::to_string(i) +
               R"(", "scale": [)" + factor + "]}}";
      if (i > 0) expect_refused(nodes);
    }
  }
  expect_refused(ball + R"({"transform": {"child": "ball", "scale": [1e-5, 1e-5, 2e-5]}},
                           {"transform": {"child": "#1", "scale": [1e-5]}})");
  const auto scene = read_scene(scene_of_nodes(ball + R"({"transform": {"child": "ball", "scale": [1e-3]}},
      {"transform": {"child": "#1", "scale": [1e-3]}}, {"transform": {"child": "#2", "scale": [1e-3]}})"));
  ASSERT_TRUE(scene.ok());
  EXPECT_TRUE(compile(*scene).ok());
  const auto refused = read_scene(scene_of_nodes(ball + R"({"transform": {"child": "ball", "scale": [1e-5]}},
      {"transform": {"child": "#1", "scale": [1e-5]}})"));
  const std::string text(compile(*refused).status().message());
  EXPECT_NE(text.find("scale it by 1e-10 to 1e-10"), std::string::npos) << text;
  EXPECT_NE(text.find("a scale of at least 1e-09"), std::string::npos) << text;
}

// The one leaf of a scene of one node.
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
        // On the skeleton, where the distance has no gradient, too.
        if (leaf.operand == Operand::kSegment && n == 0) {
          const double along = std::get<shapes::Segment>(leaf.shape).length * random.number(-0.1, 1.1);
          centre = leaf.domain.anchor + leaf.domain.to_local.linear[2] * along;
        }
        const double size = std::exp(random.number(-6, 0.5));
        const dvec3 half = random.point(0, size);
        const CentredBox box(Box{centre - half, centre + half});
        const Interval bounds = distance_bounds(leaf, box);
        for (int i = 0; i < 16; ++i) {
          // Corners are where the greatest distances lie.
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
  // Beside the cone of a tilt with sine 0.6, whose normal there is (0.8, 0, 0.6).
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
