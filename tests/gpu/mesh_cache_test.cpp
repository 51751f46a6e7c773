#include "engine/mesh/mesh_cache.h"

#include <gtest/gtest.h>

#include <memory>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::MeshCache;
using engine::MeshCells;
using engine::MeshRequest;

engine::SceneLease ball() {
  return resident(test_support::scene_of_nodes(R"({"sphere": {"radius": 1, "range": 0.5}})"));
}

MeshRequest cells_of(double size) {
  return {.cell_size = size};
}

// A mesh of so many bytes, 4 at least.
MeshCache::Kept mesh_of(std::size_t bytes) {
  MeshCells cells;
  cells.positions.resize(bytes / sizeof(float), 1);
  return {{std::make_shared<const MeshCells>(std::move(cells))}, std::nullopt};
}

TEST(MeshCache, TheSameRequestOfTheSameSceneHits) {
  MeshCache cache;
  const engine::SceneLease scene = ball();
  EXPECT_FALSE(cache.find(*scene, cells_of(0.1)));
  MeshCache::Kept mesh = mesh_of(400);
  mesh.shells = engine::ShellCounts{.bodies = 3};
  const auto part = mesh.parts[0];
  cache.keep(*scene, cells_of(0.1), std::move(mesh));
  const auto found = cache.find(*scene, cells_of(0.1));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->parts.size(), 1u);
  EXPECT_EQ(found->parts[0], part);
  EXPECT_EQ(found->shells->bodies, 3u);
  EXPECT_FALSE(cache.find(*ball(), cells_of(0.1))) << "another scene that looks the same";
}

TEST(MeshCache, ARequestThatDiffersInAnyPartMisses) {
  MeshCache cache;
  const engine::SceneLease scene = ball();
  const MeshRequest request = cells_of(0.1);
  cache.keep(*scene, request, mesh_of(400));
  const auto expect_miss = [&](const char* what, const auto& change) {
    MeshRequest other = request;
    change(other);
    EXPECT_FALSE(cache.find(*scene, other)) << what;
  };
  expect_miss("cell_size", [](MeshRequest& r) { r.cell_size = 0.11; });
  expect_miss("bounds", [](MeshRequest& r) { r.bounds = blobtree::Box{{-1, -1, -1}, {1, 1, 0}}; });
  expect_miss("iso", [](MeshRequest& r) { r.iso = 0.4; });
  expect_miss("with_normals", [](MeshRequest& r) { r.with_normals = false; });
  expect_miss("tolerance", [](MeshRequest& r) { r.tolerance = 1e-2; });
  expect_miss("max_cells", [](MeshRequest& r) { r.max_cells = 1; });
  expect_miss("part", [](MeshRequest& r) { r.part = blobtree::BrickBox{{0, 0, 0}, {1, 1, 1}}; });
  EXPECT_TRUE(cache.find(*scene, request));
}

TEST(MeshCache, TheLeastRecentlyUsedGivesWayAtTheByteLimit) {
  MeshCache cache(1000);
  const engine::SceneLease scene = ball(), other = ball();
  cache.keep(*scene, cells_of(0.1), mesh_of(400));
  cache.keep(*scene, cells_of(0.2), mesh_of(400));
  EXPECT_TRUE(cache.find(*scene, cells_of(0.1))) << "and so used last";
  const auto used = cache.find(*scene, cells_of(0.2));
  EXPECT_TRUE(cache.find(*scene, cells_of(0.1)));
  cache.keep(*other, cells_of(0.1), mesh_of(400));
  EXPECT_FALSE(cache.find(*scene, cells_of(0.2)));
  EXPECT_EQ(used->parts[0]->positions.size(), 100u) << "who has it keeps it";
  EXPECT_TRUE(cache.find(*scene, cells_of(0.1)));
  EXPECT_TRUE(cache.find(*other, cells_of(0.1)));
  // A mesh of more than half the limit is not kept, and drives nothing out.
  cache.keep(*other, cells_of(0.2), mesh_of(504));
  EXPECT_FALSE(cache.find(*other, cells_of(0.2)));
  EXPECT_TRUE(cache.find(*scene, cells_of(0.1)));
  cache.keep(*other, cells_of(0.2), mesh_of(500));
  EXPECT_TRUE(cache.find(*other, cells_of(0.2)));
  EXPECT_FALSE(cache.find(*other, cells_of(0.1)));
}

TEST(MeshCache, MeshesGoWithTheirScenes) {
  MeshCache cache;
  const engine::SceneLease staying = ball();
  const auto keep_of_a_scene_that_goes = [&] {
    const engine::SceneLease scene = ball();
    MeshCache::Kept mesh = mesh_of(400);
    const std::weak_ptr<const MeshCells> watched = mesh.parts[0];
    cache.keep(*scene, cells_of(0.1), std::move(mesh));
    EXPECT_FALSE(watched.expired());
    return watched;
  };
  // The memory is given back with the next request, whatever that is.
  std::weak_ptr<const MeshCells> watched = keep_of_a_scene_that_goes();
  cache.keep(*staying, cells_of(0.1), mesh_of(400));
  EXPECT_TRUE(watched.expired());
  watched = keep_of_a_scene_that_goes();
  EXPECT_TRUE(cache.find(*staying, cells_of(0.1)));
  EXPECT_TRUE(watched.expired());
}

TEST(MeshCache, TheMesherAnswersFromIt) {
  const engine::SceneLease scene = ball();
  engine::Mesher mesher(device(), kernels(), workers());
  const auto mesh = [&](double cell, std::vector<const float*>& places) {
    return mesher.cells(*scene, cells_of(cell), {}, [&](const MeshCells& cells) {
      places.push_back(cells.positions.data());
      return absl::OkStatus();
    });
  };
  std::vector<const float*> first, again, finer;
  ASSERT_TRUE(mesh(0.2, first).ok());
  ASSERT_TRUE(mesh(0.2, again).ok());
  ASSERT_TRUE(mesh(0.15, finer).ok());
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first, again) << "the same memory";
  EXPECT_NE(first, finer);
}

}  // namespace
}  // namespace isofield::gpu_test
