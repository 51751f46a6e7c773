// Tests slices of fields and their level curves.
#include "engine/surface/slicer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "gpu/gpu_environment.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;

engine::FieldEvaluator& fields() {
  static engine::FieldEvaluator evaluator(device(), kernels(), workers());
  return evaluator;
}

v1::Scene ball_scene() {
  return test_support::scene_of_nodes(
      R"([{"name": "ball", "sphere": {"center": [0.1, 0.2, -0.3], "radius": 1, "range": 0.5}}])");
}

TEST(Slicer, GivesTheSameBitsAsTheLattice) {
  const engine::SceneLease scene = resident(test_support::random_scene(8, {.nodes = 60}));
  // The lattice is exact in float32.
  const blobtree::Lattice lattice{{-2.125, -1.875, 0.25}, {0.15625, 0.140625, 1}, {27, 30, 1}};
  std::vector<float> grid(27 * 30);
  ASSERT_TRUE(fields().evaluate_layers(*scene, lattice, 0, engine::ResultLayout::kValue, grid).ok());
  const engine::Plane plane{{-2.125, -1.875, 0.25}, {1, 0, 0}, {0, 1, 0}, {0.15625, 0.140625}, {27, 30}};
  const auto slice = engine::slice(fields(), *scene, plane, {});
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_EQ(std::memcmp(slice->values.data(), grid.data(), 4 * grid.size()), 0);
}

TEST(Slicer, DrawsTheCircleOfASphere) {
  // The plane is slanted and goes through the centre.
  const double h = std::sqrt(0.5);
  engine::Plane plane{{}, {1, 0, 0}, {0, h, h}, {0.02, 0.025}, {141, 121}};
  plane.origin = dvec3{0.1, 0.2, -0.3} - plane.u * 1.4 - plane.v * 1.5;
  const std::vector<double> levels{0.5, 2};
  const auto slice = engine::slice(fields(), *resident(ball_scene()), plane, levels);
  ASSERT_TRUE(slice.ok()) << slice.status();
  ASSERT_EQ(slice->lines.size(), 2u);
  const engine::Polylines& circle = slice->lines[0];
  ASSERT_EQ(circle.starts.size(), 2u) << "one line";
  const std::size_t last = circle.points.size() - 2;
  EXPECT_EQ(circle.points[0], circle.points[last]);
  EXPECT_EQ(circle.points[1], circle.points[last + 1]);
  double area = 0;
  for (std::size_t i = 0; i <= last; i += 2) {
    EXPECT_NEAR(std::hypot(circle.points[i] - 1.4, circle.points[i + 1] - 1.5), 1, 1e-3);
    if (i < last) area += (circle.points[i] * circle.points[i + 3] - circle.points[i + 2] * circle.points[i + 1]) / 2;
  }
  EXPECT_NEAR(area, M_PI, 0.01) << "counter-clockwise about greater values";
  EXPECT_EQ(slice->lines[1].starts, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace isofield::gpu_test
