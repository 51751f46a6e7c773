// Tests meshes that are made by bricks and in parts.
#include <gtest/gtest.h>

#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "gpu/mesh_contents.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::MeshCells;
using engine::MeshRequest;

TEST(MeshParts, EightBoxesStitchedAreTheWhole) {
  std::size_t with_surface = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto scene = resident(test_support::random_scene(seed, {.nodes = 30}));
    if (!(scene->tape().support.max.x < 100) || scene->tape().support.empty()) continue;
    MeshRequest request{.cell_size = 0.09, .iso = scene->tape().law == operators::Law::kSigned ? 0.0 : 0.5};
    const Bricks whole = bricks_of(*scene, request);
    const auto lattice = engine::mesh_lattice(scene->tape(), request);
    ASSERT_TRUE(lattice.ok());
    Bricks stitched;
    for (int octant = 0; octant < 8; ++octant) {
      blobtree::BrickBox box;
      for (int a = 0; a < 3; ++a) {
        const std::uint32_t middle = lattice->cells[a] / blobtree::kBrickCells / 2 + 1;
        box.low[a] = octant >> a & 1 ? middle : 0;
        box.high[a] = octant >> a & 1 ? ~0u : middle;
      }
      request.part = box;
      for (auto& [place, content] : bricks_of(*scene, request)) {
        EXPECT_TRUE(stitched.emplace(place, std::move(content)).second) << "a brick of two parts";
      }
    }
    EXPECT_TRUE(whole == stitched) << "seed " << seed;
    with_surface += !whole.empty();
  }
  EXPECT_GE(with_surface, 3u);
}

TEST(MeshParts, ManySmallPartsAreTheWhole) {
  const auto scene = resident(test_support::random_scene(3, {.nodes = 60, .cuts = false, .all_operators = false}));
  engine::Mesher mesher(device(), kernels(), workers());
  MeshRequest request{.cell_size = 0.04};
  const auto whole = mesher.mesh(*scene, request, {});
  ASSERT_TRUE(whole.ok());
  ASSERT_FALSE(whole->triangles.empty());
  request.bricks_at_once = 40;
  std::size_t parts = 0;
  ASSERT_TRUE(mesher
                  .cells(*scene, request, {},
                         [&](const MeshCells&) {
                           ++parts;
                           return absl::OkStatus();
                         })
                  .ok());
  EXPECT_GT(parts, 2u);
  const auto joined = mesher.mesh(*scene, request, {});
  ASSERT_TRUE(joined.ok());
  EXPECT_EQ(whole->positions, joined->positions);
  EXPECT_EQ(whole->normals, joined->normals);
  EXPECT_EQ(whole->triangles, joined->triangles);
}

TEST(MeshParts, AFailureToDeliverEndsTheWork) {
  const auto scene = resident(test_support::random_scene(3, {.nodes = 20, .all_operators = false}));
  engine::Mesher mesher(device(), kernels(), workers());
  const absl::Status s =
      mesher.cells(*scene, {.cell_size = 0.1}, {}, [](const MeshCells&) { return absl::CancelledError("enough"); });
  EXPECT_EQ(s.message(), "enough");
}

}  // namespace
}  // namespace isofield::gpu_test
