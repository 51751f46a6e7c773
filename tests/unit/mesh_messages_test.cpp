#include "rpc/mesh_messages.h"

#include <gtest/gtest.h>

#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"

namespace isofield::rpc {
namespace {

// Returns a ball of radius 1, whose field reaches to 2.
blobtree::Tape ball() {
  v1::Scene scene;
  v1::Sphere& sphere = *scene.add_nodes()->mutable_sphere();
  sphere.set_radius(1);
  sphere.set_range(1);
  return blobtree::compile(blobtree::read_scene(scene, {}, {}).value()).value();
}

TEST(EstimatedCells, FollowTheSurface) {
  const blobtree::Tape tape = ball();
  engine::MeshRequest request{.cell_size = 0.05};
  const auto coarse = static_cast<double>(estimated_cells(tape, request));
  // The surface lies within the faces of a box of 80 cells along each edge; the alignment to bricks adds some.
  EXPECT_GE(coarse, 6.0 * 80 * 80);
  EXPECT_LE(coarse, 6.0 * 160 * 160);
  request.cell_size /= 4;
  const auto fine = static_cast<double>(estimated_cells(tape, request));
  EXPECT_GE(fine / coarse, 8);
  EXPECT_LE(fine / coarse, 32);
}

TEST(EstimatedCells, EndAtTheLimitAndAtThePart) {
  const blobtree::Tape tape = ball();
  engine::MeshRequest request{.cell_size = 0.05};
  request.max_cells = 1000;
  EXPECT_EQ(estimated_cells(tape, request), 1000u);
  request.part = blobtree::BrickBox{{1, 1, 1}, {2, 3, 2}};
  EXPECT_EQ(estimated_cells(tape, request), 2 * blobtree::kCellsPerBrick);
  request.part = blobtree::BrickBox{{1'000'000, 0, 0}, {~0u, ~0u, ~0u}};
  EXPECT_EQ(estimated_cells(tape, request), 0u) << "no such bricks";
}

}  // namespace
}  // namespace isofield::rpc
