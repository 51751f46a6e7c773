#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "operators/gradient_blend.h"
#include "reference/evaluator.h"
#include "support/finite_difference.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"

namespace isofield::reference {
namespace {

using blobtree::dvec3;
using test_support::Random;
using test_support::read_or_die;
using test_support::scene_of_nodes;

Evaluator evaluator_of(const std::string& nodes) {
  return Evaluator(read_or_die(scene_of_nodes(nodes)));
}

struct Tally {
  int tried = 0, checked = 0, off = 0;
  double worst = 0;
};

// Compares the gradient with differences of the field, at points where the differences settle.
void check_derivatives(const Evaluator& e, const dvec3& p, Tally& tally) {
  const Sample sample = e.evaluate(p);
  if (sample.value == 0) {
    EXPECT_EQ(sample.gradient, dvec3{});
    return;
  }
  ++tally.tried;
  const dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  dvec3 differences;
  double* const out[] = {&differences.x, &differences.y, &differences.z};
  for (int a = 0; a < 3; ++a) {
    const auto along = [&](double t) { return e.value(p + axes[a] * t); };
    const std::optional<double> slope = test_support::settled_slope(along, 0, 3e-5, 1e-6);
    if (!slope) return;
    *out[a] = *slope;
  }
  ++tally.checked;
  const double error = length(sample.gradient - differences) / std::max(1.0, length(differences));
  if (error < 1e-5) {
    tally.worst = std::max(tally.worst, error);
  } else {
    ++tally.off;  // differences seem to settle at a crease if they step over it alike on both sides
  }
}

void check_scenes(const test_support::RandomSceneOptions& options, std::uint64_t first_seed, int scenes,
                  const char* name) {
  Tally tally;
  for (int n = 0; n < scenes; ++n) {
    const std::uint64_t seed = first_seed + n;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Evaluator e(read_or_die(test_support::random_scene(seed, options)));
    Random random(seed);
    for (int i = 0; i < 60; ++i) check_derivatives(e, random.point(-1.6, 1.6), tally);
  }
  std::printf("%s: %d of %d points are smooth, gradients off by at most %.2g of themselves\n", name, tally.checked,
              tally.tried, tally.worst);
  EXPECT_LE(tally.off, tally.checked / 1000);
  EXPECT_GT(tally.tried, scenes * 5);
  EXPECT_GT(tally.checked, tally.tried * 8 / 10);
}

TEST(Reference, GradientIsTheDerivativeOfOnePrimitive) {
  check_scenes({.nodes = 1}, 100, 120, "primitives");
}
TEST(Reference, GradientIsTheDerivativeOfSmallScenes) {
  check_scenes({.nodes = 6}, 200, 120, "6 nodes");
}
TEST(Reference, GradientIsTheDerivativeOfBlendsOfBlends) {
  check_scenes({.nodes = 30, .cuts = false}, 300, 60, "30 nodes, no cuts");
}
TEST(Reference, GradientIsTheDerivativeOfLargeScenes) {
  check_scenes({.nodes = 200}, 400, 15, "200 nodes");
}

TEST(Reference, TheTermOfThetaMatters) {
  // The scene is a camel blend of two crossing cylinders, where leaving out g_theta grad theta must show (operators
  // note, 2.2).
  const Evaluator e = evaluator_of(R"({"cylinder": {"a": [-2,0,0], "b": [2,0,0], "radius": 0.4, "range": 0.5}},
    {"cylinder": {"a": [0,-2,0.3], "b": [0,2,0.3], "radius": 0.4, "range": 0.5}}, {"gradient": {"children": ["#0", "#1"]}})");
  Random random(7);
  double most = 0;
  for (int i = 0; i < 2000; ++i) {
    const FieldState s = e.state(random.point(-0.9, 0.9));
    const dvec3 steering{s.steering.x.v, s.steering.y.v, s.steering.z.v};
    most = std::max(most, length(s.field.d - steering));
  }
  EXPECT_GT(most, 0.1);
}

TEST(Reference, SteeringVectorIsTheGradientWithoutNestedBlends) {
  const Evaluator e = evaluator_of(R"({"sphere": {"radius": 0.5, "range": 0.7}},
    {"box": {"center": [0.4,0,0], "half_size": [0.3,0.3,0.3], "rounding": 0.1, "range": 0.6}},
    {"torus": {"major_radius": 0.6, "minor_radius": 0.2, "range": 0.5}}, {"ricci": {"children": ["#0","#1"], "exponent": 3}},
    {"sum": {"children": ["#3", "#2"]}})");
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    const FieldState s = e.state(random.point(-1, 1));
    EXPECT_NEAR(s.field.d.x, s.steering.x.v, 1e-12);
    EXPECT_NEAR(s.field.d.y, s.steering.y.v, 1e-12);
    EXPECT_NEAR(s.field.d.z, s.steering.z.v, 1e-12);
  }
}

TEST(Reference, SteeringVectorHasItsJacobian) {
  Tally tally;
  for (std::uint64_t seed = 500; seed < 540; ++seed) {
    const Evaluator e(read_or_die(test_support::random_scene(seed, {.nodes = 12})));
    Random random(seed);
    for (int i = 0; i < 40; ++i) {
      const dvec3 p = random.point(-1.5, 1.5);
      const FieldState s = e.state(p);
      if (s.field.v == 0) continue;
      const Dual rows[] = {s.steering.x, s.steering.y, s.steering.z};
      for (int row = 0; row < 3; ++row) {
        const auto along_x = [&](double t) {
          const FieldState moved = e.state(p + dvec3{t, 0, 0});
          return row == 0 ? moved.steering.x.v : row == 1 ? moved.steering.y.v : moved.steering.z.v;
        };
        ++tally.tried;
        const auto slope = test_support::settled_slope(along_x, 0, 3e-5, 1e-5);
        if (!slope) continue;
        ++tally.checked;
        const double error = std::abs(rows[row].d.x - *slope) / std::max(1.0, std::abs(*slope));
        tally.worst = std::max(tally.worst, error);
        EXPECT_LT(error, 1e-4) << "seed " << seed << " row " << row;
      }
    }
  }
  std::printf("Jacobian of the steering vector: %d of %d entries checked, off by at most %.2g\n", tally.checked,
              tally.tried, tally.worst);
  EXPECT_GT(tally.checked, tally.tried * 7 / 10);
}

TEST(Reference, PrimitivesHaveTheirFieldLaw) {
  const Evaluator e = evaluator_of(R"({"sphere": {"center": [1,2,3], "radius": 0.5, "range": 0.25}})");
  EXPECT_NEAR(e.value({1.5, 2, 3}), 0.5, 1e-15);
  EXPECT_EQ(e.value({1, 2.75 + 1e-15, 3}), 0);
  EXPECT_GT(e.value({1, 2, 3.7499}), 0);
  EXPECT_EQ(e.value({1, 2, 3}), 1);
  const double r = 0.45420201894740647 + (1 - 0.45420201894740647) * 0.1 / 0.25;
  EXPECT_NEAR(e.value({1, 2, 3.6}), std::pow(1 - r * r, 3), 1e-14);
}

TEST(Reference, OperatorsDoWhatTheContractSays) {
  const std::string two = R"({"sphere": {"radius": 0.5, "range": 0.8}},
                             {"sphere": {"center": [0.3,0,0], "radius": 0.4, "range": 0.9}}, )";
  const Evaluator first = evaluator_of(R"({"sphere": {"radius": 0.5, "range": 0.8}})");
  const Evaluator second = evaluator_of(R"({"sphere": {"center": [0.3,0,0], "radius": 0.4, "range": 0.9}})");
  const auto both = [&](const std::string& kind, const std::string& more = "") {
    return evaluator_of(two + "{\"" + kind + "\": {\"children\": [\"#0\", \"#1\"]" + more + "}}");
  };
  const Evaluator sum = both("sum"), max = both("max"), min = both("min"), difference = both("difference"),
                  ricci = both("ricci", ", \"exponent\": 3"), blend = both("gradient");
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const dvec3 p = random.point(-1.2, 1.2);
    const Sample a = first.evaluate(p), b = second.evaluate(p);
    const double f1 = a.value, f2 = b.value;
    EXPECT_DOUBLE_EQ(sum.value(p), f1 + f2);
    EXPECT_DOUBLE_EQ(max.value(p), std::max(f1, f2));
    EXPECT_DOUBLE_EQ(min.value(p), std::min(f1, f2));
    EXPECT_DOUBLE_EQ(difference.value(p), std::max(0.0, std::min(f1, 1 - f2)));
    EXPECT_NEAR(ricci.value(p), std::cbrt(f1 * f1 * f1 + f2 * f2 * f2), 1e-14);
    const double n1 = length(a.gradient) * 0.9, n2 = length(b.gradient) * 0.9;
    if (n1 * n1 < 1e-3 || n2 * n2 < 1e-3) continue;
    const double alpha = std::acos(std::clamp(dot(a.gradient, b.gradient) / (n1 * n2 / 0.81), -1.0, 1.0));
    const double theta = operators::camel().theta(alpha).v;
    EXPECT_NEAR(blend.value(p), operators::gradient_blend(f1, f2, theta, {}).g, 1e-9);
  }
}

TEST(Reference, NaryOperatorsFoldInOrder) {
  const std::string three = R"({"sphere": {"radius": 0.5, "range": 0.8}},
    {"box": {"center": [0.5,0,0], "half_size": [0.3,0.2,0.2], "range": 0.5}},
    {"sphere": {"center": [0,0.5,0], "radius": 0.4, "range": 0.6}}, )";
  for (const char* kind : {"difference", "gradient", "min"}) {
    const std::string k(kind);
    const Evaluator flat = evaluator_of(three + "{\"" + k + R"(": {"children": ["#0","#1","#2"]}})");
    const Evaluator nested = evaluator_of(three + "{\"" + k + R"(": {"children": ["#0","#1"]}}, {")" + k +
                                          R"(": {"children": ["#3","#2"]}})");
    Random random(10);
    for (int i = 0; i < 300; ++i) {
      const dvec3 p = random.point(-1.2, 1.2);
      // The largest range is that of the first child, so both scenes measure gradients alike.
      EXPECT_EQ(flat.value(p), nested.value(p)) << kind;
    }
  }
}

// Sums are above 1. If a complement is not positive, the union of complements is their greatest one.
TEST(Reference, IntersectionsOfFieldsAboveOneAreTheLeast) {
  for (const std::string kind : {"clean", "gradient", "barthe", "bernhardt"}) {
    SCOPED_TRACE(kind);
    // The operands are 2 w, 3 w and 2.5 w of the same sphere.
    const std::string sums = R"({"sphere": {"radius": 0.5, "range": 0.8}}, {"sum": {"children": ["#0", "#0"]}},
      {"sum": {"children": ["#0", "#0", "#0"]}}, {"sphere": {"center": [0.1, 0, 0], "radius": 0.5, "range": 0.8}},
      {"sum": {"children": ["#0", "#0", "#3"]}}, )";
    const auto of = [&](const char* form, const char* children) {
      return evaluator_of(sums + "{\"" + kind + "\": {\"form\": \"" + form + "\", \"children\": " + children + "}}");
    };
    const Evaluator one = evaluator_of(R"({"sphere": {"radius": 0.5, "range": 0.8}})");
    const Evaluator both = of("INTERSECTION", R"(["#2", "#1"])"), three = of("INTERSECTION", R"(["#2", "#4", "#1"])"),
                    less = of("DIFFERENCE", R"(["#2", "#0"])");
    for (const double x : {-0.1, -0.25, -0.4, -0.49}) {
      const Sample s = one.evaluate({x, 0, 0});
      ASSERT_GT(s.value, 0.5);
      for (const Evaluator* e : {&both, &three}) {
        EXPECT_DOUBLE_EQ(e->value({x, 0, 0}), 2 * s.value);
        EXPECT_NEAR(e->evaluate({x, 0, 0}).gradient.x, 2 * s.gradient.x, 1e-12);
      }
      // The complement of the first operand is negative, so the maximum is the second.
      EXPECT_DOUBLE_EQ(less.value({x, 0, 0}), 1 - s.value);
      EXPECT_DOUBLE_EQ(less.evaluate({x, 0, 0}).gradient.x, -s.gradient.x);
    }
  }
}

TEST(Reference, TransformsMoveTheField) {
  const std::string box = R"({"box": {"half_size": [0.5,0.3,0.2], "rounding": 0.1, "range": 0.4}}, )";
  const Evaluator plain = evaluator_of(box + R"({"max": {"children": ["#0"]}})");
  const Evaluator placed = evaluator_of(
      box + R"({"transform": {"child": "#0", "translation": [1,2,3], "rotation": [0,0,1,90], "scale": [2,1,0.5]}})");
  const Evaluator matrix =
      evaluator_of(box + R"({"transform": {"child": "#0", "matrix": [0,-1,0,1,  2,0,0,2,  0,0,0.5,3]}})");
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const dvec3 p = random.point(-0.8, 0.8);
    const dvec3 world{1 - p.y, 2 + 2 * p.x, 3 + 0.5 * p.z};
    EXPECT_NEAR(placed.value(world), plain.value(p), 1e-12);
    EXPECT_NEAR(matrix.value(world), plain.value(p), 1e-12);
    // A transform moves gradients by its inverse transpose.
    const dvec3 g = plain.evaluate(p).gradient, h = placed.evaluate(world).gradient;
    EXPECT_NEAR(h.x, -g.y, 1e-9);
    EXPECT_NEAR(h.y, g.x / 2, 1e-9);
    EXPECT_NEAR(h.z, g.z / 0.5, 1e-9);
  }
}

TEST(Reference, VariationTellsCreases) {
  const Evaluator e = evaluator_of(R"({"sphere": {"center": [-0.3,0,0], "radius": 0.5, "range": 0.8}},
    {"sphere": {"center": [0.3,0,0], "radius": 0.5, "range": 0.8}}, {"max": {"children": ["#0","#1"]}})");
  EXPECT_GT(test_support::gradient_variation(e, {1e-7, 0.4, 0}, 1e-5), 0.1);
  EXPECT_LT(test_support::gradient_variation(e, {1e-3, 0.4, 0}, 1e-5), 1e-3);
}

}  // namespace
}  // namespace isofield::reference
