#include "engine/simplify/mesh_measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;

v1::Scene ball_scene() {
  return test_support::scene_of_nodes(
      R"([{"name": "ball", "sphere": {"center": [0.1, 0.2, -0.3], "radius": 1, "range": 0.5}}])");
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
