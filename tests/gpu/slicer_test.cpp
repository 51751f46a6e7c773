// Slices of fields, their level curves, and measures of meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/simplify/mesh_measure.h"
#include "engine/surface/slicer.h"
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
  // Exact in float32.
  const blobtree::Lattice lattice{{-2.125, -1.875, 0.25}, {0.15625, 0.140625, 1}, {27, 30, 1}};
  std::vector<float> grid(27 * 30);
  ASSERT_TRUE(fields().evaluate_layers(*scene, lattice, 0, engine::ResultLayout::kValue, grid).ok());
  const engine::Plane plane{{-2.125, -1.875, 0.25}, {1, 0, 0}, {0, 1, 0}, {0.15625, 0.140625}, {27, 30}};
  const auto slice = engine::slice(fields(), *scene, plane, {});
  ASSERT_TRUE(slice.ok()) << slice.status();
  EXPECT_EQ(std::memcmp(slice->values.data(), grid.data(), 4 * grid.size()), 0);
}

TEST(Slicer, DrawsTheCircleOfASphere) {
  // A slanted plane through the centre.
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

TEST(IsoLines, EndAtTheBorderAndJoinByTheMean) {
  // Two corners above: joined where the mean of the four is above too.
  const std::vector<float> joined{1, 0, 0, 1}, parted{1, 0, 0, 0.9f};
  EXPECT_EQ(engine::iso_lines(joined, {2, 2}, 0.4f).starts, (std::vector<std::uint32_t>{0, 2, 4}));
  const engine::Polylines apart = engine::iso_lines(parted, {2, 2}, 0.5f);
  ASSERT_EQ(apart.starts, (std::vector<std::uint32_t>{0, 2, 4}));
  // Each about its own corner.
  for (const std::size_t line : {0u, 4u}) {
    const float* p = &apart.points[line];
    EXPECT_LE(std::hypot(p[0] - p[2], p[1] - p[3]), 0.75);
  }
  EXPECT_EQ(engine::iso_lines(joined, {4, 1}, 0.5f).starts, std::vector<std::uint32_t>{0});
}

TEST(MeshMeasure, FollowsTheFormulas) {
  engine::Mesher mesher(device(), kernels(), workers());
  const auto ball = mesher.mesh(*resident(ball_scene()), {.cell_size = 0.02}, {});
  ASSERT_TRUE(ball.ok());
  const engine::MeshMeasures m = engine::measure(*ball);
  EXPECT_NEAR(m.volume, 4.0 / 3 * M_PI, 2e-3);
  EXPECT_NEAR(m.area, 4 * M_PI, 3e-3);
  EXPECT_LE(length(m.centroid - dvec3{0.1, 0.2, -0.3}), 1e-4);
  EXPECT_LE(length(m.bounds.min - dvec3{-0.9, -0.8, -1.3}), 1e-3);
  EXPECT_LE(length(m.bounds.max - dvec3{1.1, 1.2, 0.7}), 1e-3);
  const auto box =
      mesher.mesh(*resident(test_support::scene_of_nodes(
                      R"([{"box": {"center": [100, 0, 0], "half_size": [1, 0.5, 0.25], "range": 0.25}}])")),
                  {.cell_size = 0.01}, {});
  ASSERT_TRUE(box.ok());
  const engine::MeshMeasures b = engine::measure(*box);
  // The edges are chamfered within a cell.
  EXPECT_NEAR(b.volume, 1, 2e-3);
  EXPECT_NEAR(b.area, 7, 0.1);
  EXPECT_LE(length(b.centroid - dvec3{100, 0, 0}), 1e-4);
  const engine::MeshMeasures none = engine::measure({});
  EXPECT_EQ(none.volume, 0);
  EXPECT_TRUE(none.bounds.empty());
}

}  // namespace
}  // namespace isofield::gpu_test
