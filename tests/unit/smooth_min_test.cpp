#include "operators/smooth_min.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::operators {
namespace {

// This is the form that shader programmers know: min(a, b) - max(k - |a - b|, 0)^2 / (4 k).
double well_known(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * k);
}

TEST(SmoothMin, IsTheQuadraticOne) {
  test_support::Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const double a = random.number(-2, 2), b = random.number(-2, 2), k = random.number(0.01, 3), step = 1e-6;
    const SmoothMin op{k};
    const Binary<double> r = op.unite(a, b);
    ASSERT_NEAR(r.g, well_known(a, b, k), 1e-14);
    ASSERT_NEAR(r.g1, (well_known(a + step, b, k) - well_known(a - step, b, k)) / (2 * step), 1e-4);
    ASSERT_NEAR(r.g1 + r.g2, 1, 1e-15);
    if (std::abs(a - b) >= k) {
      ASSERT_EQ(r.g, std::min(a, b));
    }
  }
}

TEST(SmoothMin, HoldsItsBounds) {
  test_support::Random random(5);
  for (int n = 0; n < 2000; ++n) {
    const SmoothMin op{random.number(0.05, 2)};
    const auto interval = [&] {
      const double lo = random.number(-2, 2);
      return Interval{lo, lo + random.number(0, 1)};
    };
    const Interval a = interval(), b = interval(), r = op.bound(a, b);
    const int alone = op.lone_operand(a, b);
    for (int i = 0; i < 20; ++i) {
      const double x = random.number(a.lo, a.hi), y = random.number(b.lo, b.hi), g = op.unite(x, y).g;
      ASSERT_GE(g, r.lo);
      ASSERT_LE(g, r.hi);
      if (alone >= 0) {
        ASSERT_EQ(g, alone == 0 ? x : y);
      }
      // If the result is at most r, the lesser operand is at most r plus the reach.
      ASSERT_LE(std::min(x, y), g + op.reached(0).reach + 1e-12);
    }
  }
}

// A device computes in float32. Its results lie within the bounds, too, even where two terms cancel.
TEST(SmoothMin, LeavesRoomForRounding) {
  for (const double radius : {0.01, 1.0, 1000.0}) {
    const SmoothMin op{radius};
    const double x = radius / 4;  // the result of x and x is 0
    const Interval r = op.bound({x, x}, {x, x});
    EXPECT_LT(r.lo, -1e-7 * radius);
    EXPECT_GT(r.hi, 1e-7 * radius);
  }
}

TEST(SmoothMin, IsReadWithItsRadius) {
  const std::string balls = R"([{"sphere": {"radius": 1, "law": "SIGNED"}},
      {"sphere": {"center": [1, 0, 0], "radius": 1, "law": "SIGNED"}}, )";
  const auto read = [&](const std::string& body) {
    return blobtree::read_scene(test_support::scene_of_nodes(
        balls + R"({"name": "s", "smooth_min": {"children": ["#0", "#1"])" + body + "}}]"));
  };
  const auto scene = read(R"(, "radius": 0.5, "form": "INTERSECTION")");
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->nodes[2].op->as<SmoothMin>()->radius, 0.5);
  EXPECT_EQ(scene->nodes[2].op->form, Form::kIntersection);
  const auto missing = read("");
  EXPECT_NE(std::string(missing.status().message()).find("'s'.radius is missing or 0"), std::string::npos)
      << missing.status();
}

}  // namespace
}  // namespace isofield::operators
