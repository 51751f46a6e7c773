// Meshes that follow the edits of a scene.
#include "engine/mesh/mesh_tracker.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "gpu/mesh_contents.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::MeshCells;
using engine::MeshRequest;

// Spheres that lie densely, under one operator.
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
          case 0:  // across the model, perhaps over its edge
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
      ASSERT_TRUE(fresh == followed) << "step " << step << ": " << fresh.size() << " bricks, " << followed.size()
                                     << " followed";
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

// Applies an update to what is known of a mesh.
void follow(const engine::MeshTracker::Update& update, Bricks& followed) {
  if (update.is_whole) followed.clear();
  for (const auto& [x, y, z] : update.removed) EXPECT_EQ(followed.erase({x, y, z}), 1u);
  for (const MeshCells& cells : update.changed) put(cells, followed);
}

// Edits of blends, of signed leaves and of what is there at all, after which no part of the mesh is known to be the
// same, and an edit that moves the lattice.
TEST(MeshTracker, FollowsEditsThatReachEverywhere) {
  const char* const ball = R"({"sphere": {"center": [0.1, 0.2, 0], "radius": 0.5, "range": 0.5}}, )";
  const char* const other = R"({"sphere": {"center": [0.6, 0, 0.1], "radius": 0.4, "range": 0.5}}, )";
  const char* const far = R"({"sphere": {"center": [3, 0, 0.1], "radius": 0.4, "range": 0.5}}, )";
  const std::string scenes[] = {
      std::string(ball) + other + R"({"gradient": {"children": ["#0", "#1"]}})",
      std::string(ball) + other + R"({"gradient": {"children": ["#0", "#1"], "opening": {"preset": "ORGANIC"}}})",
      std::string(ball) + other + R"({"ricci": {"children": ["#0", "#1"], "exponent": 2}})",
      std::string(ball) + other + R"({"ricci": {"children": ["#0", "#1"], "exponent": 4}})",
      std::string(ball) + far + R"({"ricci": {"children": ["#0", "#1"], "exponent": 4}})",
      std::string(ball) + other + far + R"({"ricci": {"children": ["#0", "#1", "#2"], "exponent": 4}})",
      R"({"sphere": {"radius": 0.5, "law": "SIGNED"}}, {"soften": {"child": "#0", "range": 0.5}})",
      R"({"sphere": {"radius": 0.7, "law": "SIGNED"}}, {"soften": {"child": "#0", "range": 0.5}})",
  };
  const MeshRequest request{.cell_size = 0.06};
  engine::Mesher mesher(device(), kernels(), workers());
  engine::MeshTracker tracker(mesher, request);
  Bricks followed;
  for (const std::string& nodes : scenes) {
    SCOPED_TRACE(nodes);
    const auto now = resident(test_support::scene_of_nodes(nodes));
    const auto update = tracker.update(now, {});
    ASSERT_TRUE(update.ok()) << update.status();
    follow(*update, followed);
    const Bricks fresh = bricks_of(*now, request);
    EXPECT_FALSE(fresh.empty());
    ASSERT_TRUE(fresh == followed) << fresh.size() << " bricks, " << followed.size() << " followed";
    std::uint64_t vertices = 0, triangles = 0;
    for (const auto& [place, content] : fresh) {
      vertices += content.positions.size() / 3;
      triangles += content.corners.size() / 3;
    }
    EXPECT_EQ(tracker.vertices(), vertices);
    EXPECT_EQ(tracker.triangles(), triangles);
  }
}

TEST(ChangedLeaves, AreNamedInBothScenes) {
  test_support::Random random(11);
  const v1::Scene scene = balls(random, 10, true);
  const auto before = resident(scene);
  v1::Scene moved = scene;
  moved.mutable_nodes(4)->mutable_sphere()->set_radius(0.22);
  const auto after = resident(moved);
  const auto changed = engine::changed_leaves(*before, *after);
  ASSERT_TRUE(changed);
  ASSERT_EQ(changed->size(), 2u);
  for (const blobtree::Leaf* leaf : *changed) EXPECT_EQ(leaf->node, 4u);
  EXPECT_NE((*changed)[0]->support.max.x, (*changed)[1]->support.max.x) << "one is of the scene after";
  EXPECT_EQ(engine::changed_leaves(*before, *resident(scene))->size(), 0u);
  v1::Scene blended = scene;
  blended.mutable_nodes(10)->mutable_gradient()->mutable_opening()->set_preset(v1::Opening::ORGANIC);
  EXPECT_FALSE(engine::changed_leaves(*before, *resident(blended)));
}

}  // namespace
}  // namespace isofield::gpu_test
