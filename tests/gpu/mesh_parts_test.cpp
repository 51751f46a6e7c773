// Tests meshes by bricks: made in parts, and followed through edits.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <tuple>

#include "engine/mesh/mesh_lattice.h"
#include "engine/mesh/mesh_tracker.h"
#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::MeshBrick;
using engine::MeshCells;
using engine::MeshRequest;

struct Place {
  std::uint32_t x, y, z;
};
struct InOrder {
  bool operator()(const Place& a, const Place& b) const { return engine::comes_before(a, b); }
};
// The vertices and triangles of one brick.
struct Content {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> corners;
  bool operator==(const Content&) const = default;
};
using Bricks = std::map<Place, Content, InOrder>;

void put(const MeshCells& cells, Bricks& bricks) {
  std::size_t vertex = 0, triangle = 0;
  for (const MeshBrick& b : cells.bricks) {
    const auto part = [](const auto& from, std::size_t first, std::size_t count) {
      return std::decay_t<decltype(from)>(from.begin() + 3 * first, from.begin() + 3 * (first + count));
    };
    bricks[{b.x, b.y, b.z}] = {part(cells.positions, vertex, b.vertices), part(cells.normals, vertex, b.vertices),
                               part(cells.corners, triangle, b.triangles)};
    vertex += b.vertices;
    triangle += b.triangles;
  }
}

Bricks bricks_of(const engine::ResidentScene& scene, const MeshRequest& request) {
  engine::Mesher mesher(device(), kernels(), workers());  // it has kept nothing
  Bricks bricks;
  const absl::Status s = mesher.cells(scene, request, {}, [&](const MeshCells& cells) {
    EXPECT_TRUE(std::is_sorted(cells.bricks.begin(), cells.bricks.end(), engine::comes_before<MeshBrick, MeshBrick>));
    put(cells, bricks);
    return absl::OkStatus();
  });
  EXPECT_TRUE(s.ok()) << s;
  return bricks;
}

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
    EXPECT_TRUE(std::equal(whole.begin(), whole.end(), stitched.begin(), stitched.end(),
                           [](const auto& a, const auto& b) {
                             return std::tie(a.first.x, a.first.y, a.first.z) ==
                                        std::tie(b.first.x, b.first.y, b.first.z) &&
                                    a.second == b.second;
                           }))
        << "seed " << seed;
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

// Makes a scene of densely placed spheres under one operator.
v1::Scene balls(test_support::Random& random, int count, bool is_blended) {
  v1::Scene scene;
  for (int i = 0; i < count; ++i) {
    auto* s = scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s->add_center(random.number(-1, 1));
    s->set_radius(random.number(0.1, 0.2));
    s->set_range(0.15);
  }
  v1::Node& root = *scene.add_nodes();
  for (int i = 0; i < count; ++i) {
    const std::string child = test_support::place(i);
    if (is_blended) {
      root.mutable_gradient()->add_children(child);
    } else {
      root.mutable_max()->add_children(child);
    }
  }
  return scene;
}

TEST(MeshTracker, LeadsToTheMeshOfAFreshRequest) {
  for (const bool is_blended : {false, true}) {
    test_support::Random random(7);
    v1::Scene scene = balls(random, 60, is_blended);
    const MeshRequest request{.cell_size = 0.03};
    engine::Mesher mesher(device(), kernels(), workers());
    engine::MeshTracker tracker(mesher, request);
    Bricks followed;
    std::size_t sent = 0, all = 0;
    for (int step = 0; step < 25; ++step) {
      if (step > 0) {
        auto& sphere = *scene.mutable_nodes(random.integer(0, 59))->mutable_sphere();
        switch (step % 5) {
          case 0:  // moves it across the model, perhaps over its edge
            for (int a = 0; a < 3; ++a) sphere.set_center(a, random.number(-1.3, 1.3));
            break;
          case 1:
            sphere.set_radius(random.number(0.05, 0.3));
            break;
          case 2:
            sphere.set_range(random.number(0.1, 0.2));
            break;
          default:
            for (int a = 0; a < 3; ++a) sphere.set_center(a, sphere.center(a) + random.number(-0.05, 0.05));
        }
      }
      const auto now = resident(scene);
      const auto update = tracker.update(now, {});
      ASSERT_TRUE(update.ok()) << update.status();
      EXPECT_EQ(update->is_whole || step > 0, true);
      if (update->is_whole) followed.clear();
      for (const auto& [x, y, z] : update->removed) EXPECT_EQ(followed.erase({x, y, z}), 1u);
      for (const MeshCells& cells : update->changed) {
        put(cells, followed);
        sent += step > 0 ? cells.bricks.size() : 0;
      }
      const Bricks fresh = bricks_of(*now, request);
      all += step > 0 ? fresh.size() : 0;
      ASSERT_TRUE(std::equal(fresh.begin(), fresh.end(), followed.begin(), followed.end(),
                             [](const auto& a, const auto& b) {
                               return std::tie(a.first.x, a.first.y, a.first.z) ==
                                          std::tie(b.first.x, b.first.y, b.first.z) &&
                                      a.second == b.second;
                             }))
          << "step " << step << ": " << fresh.size() << " bricks, " << followed.size() << " followed";
    }
    std::cout << sent << " bricks sent for " << all << " of the meshes\n";
    EXPECT_LT(sent, all / 2);
  }
}

TEST(MeshTracker, SeesThatNothingChanged) {
  test_support::Random random(9);
  const v1::Scene scene = balls(random, 20, true);
  engine::Mesher mesher(device(), kernels(), workers());
  engine::MeshTracker tracker(mesher, {.cell_size = 0.05});
  ASSERT_TRUE(tracker.update(resident(scene), {}).ok());
  const auto again = tracker.update(resident(scene), {});
  ASSERT_TRUE(again.ok());
  EXPECT_FALSE(again->is_whole);
  EXPECT_TRUE(again->removed.empty());
  EXPECT_TRUE(again->changed.empty());
}

TEST(MeshTracker, StartsAnewAfterACancelledUpdate) {
  test_support::Random random(9);
  v1::Scene scene = balls(random, 20, true);
  engine::Mesher mesher(device(), kernels(), workers());
  engine::MeshTracker tracker(mesher, {.cell_size = 0.05});
  ASSERT_TRUE(tracker.update(resident(scene), {}).ok());
  scene.mutable_nodes(3)->mutable_sphere()->set_radius(0.25);
  EXPECT_TRUE(absl::IsCancelled(tracker.update(resident(scene), {.cancelled = [] { return true; }}).status()));
  const auto update = tracker.update(resident(scene), {});
  ASSERT_TRUE(update.ok());
  EXPECT_TRUE(update->is_whole);
  EXPECT_FALSE(update->changed.empty());
}

}  // namespace
}  // namespace isofield::gpu_test
