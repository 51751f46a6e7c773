// Compares every kind of primitive on the device with double precision: by itself, of either law, and under several
// maps.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "gpu/device_field.h"
#include "support/primitive_nodes.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using test_support::PrimitiveNode;

// The primitive is left as it is, turned and scaled, and put under a map that keeps no angles.
constexpr const char* kMaps[] = {"", R"("rotation": [1, 2, -3, 40], "scale": [1.5], "translation": [0.2, -0.1, 0.3])",
                                 R"("rotation": [1, 1, 0, 25], "scale": [1.4, 0.7, 1], "translation": [0.1, 0, -0.2])"};

std::vector<dvec3> points_around(std::uint64_t seed, int count) {
  test_support::Random random(seed);
  std::vector<dvec3> points;
  for (int i = 0; i < count; ++i) points.push_back(rounded_to_float(random.point(-2, 2)));
  return points;
}

// Compares values and, where the gradient holds still around a point, gradients.
void expect_as_reference(const std::string& nodes, double tolerance) {
  SCOPED_TRACE(nodes);
  const v1::Scene scene = test_support::scene_of_nodes(nodes);
  const reference::Evaluator evaluator(test_support::read_or_die(scene));
  const std::vector<dvec3> points = points_around(5, 2000);
  const std::vector<reference::Sample> samples = DeviceField(scene).samples(points);
  double worst = 0, worst_gradient = 0;
  int smooth = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const reference::Sample e = evaluator.evaluate(points[i]);
    test_support::keep_worst(worst, std::abs(samples[i].value - e.value));
    if (test_support::gradient_variation(evaluator, points[i], 1e-5) > 1e-3) continue;
    ++smooth;
    test_support::keep_worst(worst_gradient, length(samples[i].gradient - e.gradient));
  }
  std::cout << "values off by " << worst << ", gradients by " << worst_gradient << " at " << smooth
            << " smooth points\n";
  EXPECT_LE(worst, tolerance);
  EXPECT_LE(worst_gradient, 100 * tolerance);
  EXPECT_GE(smooth, static_cast<int>(points.size()) / 2);
}

std::string placed(const PrimitiveNode& primitive, bool is_signed, const std::string& map) {
  std::string nodes = primitive.text("p", is_signed);
  if (!map.empty()) absl::StrAppend(&nodes, R"(, {"name": "placed", "transform": {"child": "p", )", map, "}}");
  return nodes;
}

TEST(Primitives, AreTheReferencesOfEitherLawAndUnderAnyMap) {
  for (const PrimitiveNode& primitive : test_support::primitive_nodes()) {
    for (const bool is_signed : {false, true}) {
      for (const char* map : kMaps)
        expect_as_reference(absl::StrCat("[", placed(primitive, is_signed, map), "]"), 3e-6);
    }
  }
}

// The gradient of the blend contains second derivatives of its operands.
TEST(Primitives, BlendByTheirGradientsAsTheReferenceDoes) {
  for (const PrimitiveNode& primitive : test_support::primitive_nodes()) {
    for (const char* map : {kMaps[0], kMaps[2]}) {
      const std::string first = placed(primitive, false, map);
      expect_as_reference(
          absl::StrCat("[", first, R"(, {"sphere": {"center": [0.6, 0.5, 0.2], "radius": 0.6, "range": 0.7}},
          {"gradient": {"children": [")",
                       *map == 0 ? "p" : "placed", R"(", "#)", *map == 0 ? 1 : 2, R"("]}}])"),
          5e-6);
    }
  }
}

}  // namespace
}  // namespace isofield::gpu_test
