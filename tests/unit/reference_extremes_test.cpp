// Tests the reference evaluator at points and in scenes where a primitive or an operator degenerates.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::reference {
namespace {

using blobtree::dvec3;
using test_support::read_or_die;
using test_support::scene_of_nodes;

void expect_finite(const Evaluator& e, const dvec3& p) {
  const FieldState s = e.state(p);
  const auto check = [&](const Dual& x) {
    EXPECT_TRUE(std::isfinite(x.v) && std::isfinite(x.d.x) && std::isfinite(x.d.y) && std::isfinite(x.d.z))
        << "at (" << p.x << ", " << p.y << ", " << p.z << ")";
  };
  check(s.field);
  check(s.steering.x);
  check(s.steering.y);
  check(s.steering.z);
  EXPECT_GE(s.field.v, 0);
}

// Returns centres, points of axes, medial surfaces and edges, and points next to them.
std::vector<dvec3> special_points() {
  std::vector<dvec3> points;
  const double places[] = {0, 1e-300, 1e-160, 1e-30, 1e-16, 1e-8, 0.25, 0.3, 0.5, 1, -0.5, -1e-9, 1e9, -1e200};
  for (const double x : places) {
    for (const double y : places) {
      for (const double z : places) points.push_back({x, y, z});
    }
  }
  return points;
}

// The ranges are so large that no clamp hides the centres.
const char* const kPrimitives[] = {
    R"({"sphere": {"radius": 0.5, "range": 5}})",
    R"({"segment": {"a": [0,0,0], "b": [0,0,1], "radius_a": 0.5, "radius_b": 0.5, "range": 5}})",
    R"({"segment": {"a": [0,0,0], "b": [0,0,1], "radius_a": 0.5, "radius_b": 0.3, "range": 5}})",
    R"({"segment": {"a": [0,0,0], "b": [0,0,1], "radius_a": 1.5, "radius_b": 0.5, "range": 5}})",
    R"({"segment": {"a": [0,0,0], "b": [0,0,0], "radius_a": 0.5, "radius_b": 0.5, "range": 5}})",
    R"({"box": {"half_size": [0.5,0.5,0.5], "range": 5}})",
    R"({"box": {"half_size": [0.5,0.3,0.25], "rounding": 0.25, "range": 5}})",
    R"({"cylinder": {"a": [0,0,-0.5], "b": [0,0,0.5], "radius": 0.5, "range": 5}})",
    R"({"torus": {"major_radius": 0.5, "minor_radius": 0.25, "range": 5}})",
    R"({"torus": {"major_radius": 0.25, "minor_radius": 0.5, "range": 5}})",
    R"({"ellipsoid": {"semi_axes": [0.5,0.3,0.25], "range": 5}})",
};

TEST(ReferenceExtremes, PrimitivesAreFinite) {
  for (const char* primitive : kPrimitives) {
    SCOPED_TRACE(primitive);
    const Evaluator e(read_or_die(scene_of_nodes(primitive)));
    for (const dvec3& p : special_points()) expect_finite(e, p);
  }
}

TEST(ReferenceExtremes, BlendsOfAPrimitiveWithItselfAreFinite) {
  const char* const blends[] = {
      R"("gradient": {)",
      R"("gradient": {"silhouette": {"kind": "BULGE", "k": 1},)",
      R"("gradient": {"opening": {"preset": "CAMEL", "theta0": 0, "theta1": 0, "theta2": 0},)",
      R"("gradient": {"opening": {"preset": "CAMEL", "theta0": 45, "theta1": 45, "theta2": 45},)",
      R"("gradient": {"opening": {"preset": "CONTACT", "w0": 0.05, "w1": 0.05},)",
      R"("ricci": {"exponent": 1,)",
      R"("ricci": {"exponent": 64,)",
      R"("difference": {)",
      R"("min": {)"};
  const std::vector<dvec3> points = special_points();
  for (const char* primitive : kPrimitives) {
    for (const std::string blend : blends) {
      SCOPED_TRACE(std::string(primitive) + blend);
      // The scene has f > 1 in the sum, identical operands, and blends of blends.
      const std::string nodes = std::string(primitive) + ", {\"sum\": {\"children\": [\"#0\", \"#0\", \"#0\"]}}, {" +
                                blend +
                                R"("children": ["#0", "#0", "#1"]}}, {"gradient": {"children": ["#2", "#0", "#2"]}})";
      const Evaluator e(read_or_die(scene_of_nodes(nodes)));
      for (std::size_t i = 0; i < points.size(); i += 23) expect_finite(e, points[i]);
    }
  }
}

TEST(ReferenceExtremes, AnglesOfZeroAndPiAreFinite) {
  // Gradients are opposite between two spheres on their common axis, and parallel beyond either sphere.
  const Evaluator e(read_or_die(scene_of_nodes(R"({"sphere": {"center": [-0.5,0,0], "radius": 0.5, "range": 2}},
    {"sphere": {"center": [0.5,0,0], "radius": 0.5, "range": 2}}, {"gradient": {"children": ["#0","#1"]}})")));
  for (double x = -3; x <= 3; x += 0.01) {
    for (const double y : {0.0, 1e-300, 1e-17, 1e-9}) {
      expect_finite(e, {x, y, 0});
      // The scene is symmetric, so the field is, too.
      EXPECT_NEAR(e.value({x, y, 0}), e.value({-x, y, 0}), 1e-12);
    }
  }
  // Gradients are parallel here, and camel makes a clean union of them.
  EXPECT_NEAR(e.value({2, 0, 0}),
              Evaluator(read_or_die(scene_of_nodes(R"({"sphere": {"center": [0.5,0,0], "radius": 0.5, "range": 2}})")))
                  .value({2, 0, 0}),
              1e-3);
}

TEST(ReferenceExtremes, OpposedDifferencesVanishExactly) {
  const Evaluator e(read_or_die(
      scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.2}}, {"difference": {"children": ["#0", "#0"]}})")));
  const Sample inside = e.evaluate({0, 0, 0});
  EXPECT_EQ(inside.value, 0);
  EXPECT_EQ(inside.gradient, dvec3{});
  EXPECT_NEAR(e.value({0.5, 0, 0}), 0.5, 1e-12);
}

TEST(ReferenceExtremes, NullGradientsOpenTheBlendSmoothly) {
  // The gradient of each sphere vanishes at its centre, and theta is the least of organic's angles there: 0.
  const std::string nodes = R"({"sphere": {"radius": 0.5, "range": 2}},
    {"sphere": {"center": [0.2,0,0], "radius": 0.5, "range": 2}},
    {"gradient": {"children": ["#0","#1"], "opening": {"preset": "ORGANIC"}}})";
  const Evaluator e(read_or_die(scene_of_nodes(nodes)));
  double before = e.value({-0.05, 0.01, 0});
  for (double x = -0.05; x < 0.25; x += 5e-5) {
    const double now = e.value({x, 0.01, 0});
    ASSERT_LT(std::abs(now - before), 2e-3) << x;
    before = now;
  }
}

TEST(ReferenceExtremes, RandomScenesAreFiniteAtSpecialPoints) {
  const std::vector<dvec3> points = special_points();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Evaluator e(read_or_die(test_support::random_scene(seed, {.nodes = 20})));
    for (std::size_t i = seed % 29; i < points.size(); i += 29) expect_finite(e, points[i]);
  }
}

}  // namespace
}  // namespace isofield::reference
