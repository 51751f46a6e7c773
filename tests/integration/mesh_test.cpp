// Tests MeshService: what a request may state, determinism, and a cost that follows the surface.
#include <gtest/gtest.h>
#include <isofield/client.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "support/mesh_check.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::integration_test {
namespace {

class Mesh : public testing::Test {
 protected:
  static void expect_sound(const ReceivedMesh& mesh) {
    const test_support::MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
    EXPECT_TRUE(report.sound()) << report.text();
    EXPECT_EQ(report.unused_vertices, 0u);
  }

  Ball ball_;
  Peer peer_{shared_daemon().address()};
};

TEST_F(Mesh, OfABallIsTheBall) {
  v1::SceneSummary summary;
  ASSERT_TRUE(ok(peer_.put("ball", ball_.scene(), &summary)));
  const ReceivedMesh received = peer_.mesh(mesh_request(named("ball"), 0.02));
  expect_sound(received);
  EXPECT_EQ(received.summary.cell_size(), 0.02);
  EXPECT_EQ(received.summary.scene_version(), summary.version());
  EXPECT_GT(received.summary.cells(), 0u);
  EXPECT_GE(received.summary.seconds(), 0);
  double worst_distance = 0, worst_turn = 0;
  ASSERT_EQ(received.normals.size(), received.positions.size());
  for (std::size_t v = 0; v < received.positions.size(); v += 3) {
    const float* const p = &received.positions[v];
    const std::array<double, 3> r{p[0] - ball_.center[0], p[1] - ball_.center[1], p[2] - ball_.center[2]};
    const double distance = std::hypot(r[0], r[1], r[2]);
    worst_distance = std::max(worst_distance, std::abs(distance - ball_.radius));
    for (int a = 0; a < 3; ++a) {
      worst_turn = std::max(worst_turn, std::abs(received.normals[v + a] - r[a] / distance));
    }
  }
  EXPECT_LE(worst_distance, 0.01 * 0.02);
  EXPECT_LE(worst_turn, 1e-3);
  EXPECT_TRUE(ok(peer_.remove("ball")));
}

TEST_F(Mesh, OfTheSameRequestIsTheSameBytes) {
  const v1::Scene scene = test_support::random_scene(5, {.nodes = 80});
  const v1::MeshRequest request = mesh_request(inlined(scene), 0.04);
  const ReceivedMesh first = peer_.mesh(request), second = peer_.mesh(request);
  expect_sound(first);
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.normals, second.normals);
  EXPECT_EQ(first.summary.cells(), second.summary.cells());
  // Another daemon, with other scenes before it, makes the same mesh.
  Daemon daemon;
  Peer other(daemon.address());
  ReceivedMesh third;
  ASSERT_TRUE(ok(other.mesh(request, &third)));
  EXPECT_EQ(first.triangles, third.triangles);
  EXPECT_EQ(first.positions, third.positions);
  EXPECT_EQ(first.normals, third.normals);
}

TEST_F(Mesh, CanGoWithoutNormals) {
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.1);
  const ReceivedMesh with = peer_.mesh(request);
  request.set_omit_normals(true);
  const ReceivedMesh without = peer_.mesh(request);
  ASSERT_FALSE(with.triangles.empty());
  EXPECT_EQ(with.normals.size(), with.positions.size());
  EXPECT_TRUE(without.normals.empty());
  EXPECT_EQ(without.positions, with.positions);
  EXPECT_EQ(without.triangles, with.triangles);
}

TEST_F(Mesh, CellsAreCountedAlongTheLongestEdge) {
  v1::MeshRequest request;
  *request.mutable_scene() = inlined(ball_.scene());
  request.set_resolution(60);
  EXPECT_NEAR(peer_.mesh(request).summary.cell_size(), 3.0 / 60, 1e-6);
  for (const double x : {-2.0, -2.0, -2.0}) request.add_bounds_min(x);
  for (const double x : {4.0, 2.0, 2.0}) request.add_bounds_max(x);
  EXPECT_NEAR(peer_.mesh(request).summary.cell_size(), 0.1, 1e-12);
}

TEST_F(Mesh, WithoutACellSizeTheServerChoosesOne) {
  v1::MeshRequest request;
  *request.mutable_scene() = inlined(ball_.scene());
  const ReceivedMesh received = peer_.mesh(request);
  expect_sound(received);
  EXPECT_GT(received.summary.cell_size(), 0);
  EXPECT_LE(received.summary.cell_size(), 3.0 / 128 * 1.0001);
  EXPECT_LE(received.summary.cells(), 1u << 22);
}

TEST_F(Mesh, IsCappedAtStatedBounds) {
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.05);
  for (const double x : {-3.0, -3.0, -3.0}) request.add_bounds_min(x);
  for (const double x : {0.25, 3.0, 3.0}) request.add_bounds_max(x);
  const ReceivedMesh received = peer_.mesh(request);
  expect_sound(received);
  for (std::size_t v = 0; v < received.positions.size(); v += 3) ASSERT_LE(received.positions[v], 0.25f);
  const double volume = test_support::check_mesh(received.positions, received.triangles).volume;
  EXPECT_NEAR(volume, 2.0 / 3 * M_PI, 0.2);
}

TEST_F(Mesh, FollowsTheIsoValue) {
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.05);
  double last = 1e9;
  for (const double iso : {0.05, 0.3, 0.5, 0.8}) {
    request.set_iso(iso);
    const ReceivedMesh received = peer_.mesh(request);
    expect_sound(received);
    const double volume = test_support::check_mesh(received.positions, received.triangles).volume;
    EXPECT_LT(volume, last);
    last = volume;
  }
}

TEST_F(Mesh, VerticesAreAsNearAsTheToleranceSays) {
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.05);
  const ReceivedMesh usual = peer_.mesh(request);
  request.set_tolerance(1e-3);
  EXPECT_EQ(peer_.mesh(request).positions, usual.positions) << "the default";
  double last = 1;
  for (const double tolerance : {0.1, 1e-3}) {
    request.set_tolerance(tolerance);
    const ReceivedMesh received = peer_.mesh(request);
    expect_sound(received);
    double sum = 0;
    for (std::size_t v = 0; v < received.positions.size(); v += 3) {
      const float* const p = &received.positions[v];
      const double r = std::hypot(p[0] - ball_.center[0], p[1] - ball_.center[1], p[2] - ball_.center[2]);
      sum += std::abs(r - ball_.radius) / 0.05;
    }
    const double mean = 3 * sum / static_cast<double>(received.positions.size());
    EXPECT_LE(mean, tolerance);
    EXPECT_LT(mean, last / 2);
    last = mean;
  }
}

TEST_F(Mesh, IsSimplifiedWithinTheError) {
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.04);
  const ReceivedMesh whole = peer_.mesh(request);
  request.set_simplification_error(0.004);
  const ReceivedMesh received = peer_.mesh(request);
  expect_sound(received);
  EXPECT_LT(received.triangles.size(), whole.triangles.size() / 4);
  EXPECT_EQ(received.summary.vertices(), received.positions.size() / 3);
  EXPECT_EQ(received.summary.triangles(), received.triangles.size() / 3);
  EXPECT_EQ(received.summary.cells(), whole.summary.cells());
  EXPECT_EQ(received.normals.size(), received.positions.size());
  for (std::size_t t = 0; t < received.triangles.size(); t += 3) {
    std::array<double, 3> middle{};
    for (std::size_t c = t; c < t + 3; ++c) {
      for (int a = 0; a < 3; ++a) middle[a] += received.positions[3 * std::size_t{received.triangles[c]} + a] / 3.0;
    }
    const double r = std::hypot(middle[0] - ball_.center[0], middle[1] - ball_.center[1], middle[2] - ball_.center[2]);
    // The bound includes how far the lattice's own triangles lie off.
    EXPECT_NEAR(r, ball_.radius, 1.2 * 0.004 + 0.04 * 0.04 / ball_.radius);
  }
  EXPECT_EQ(peer_.mesh(request).positions, received.positions);
  EXPECT_EQ(peer_.mesh(request).triangles, received.triangles);

  LimitedContext context;
  v1::MeasureResponse measured;
  ASSERT_TRUE(ok(peer_.meshes().Measure(&context, request, &measured)));
  EXPECT_EQ(measured.summary().triangles(), received.summary.triangles());
  EXPECT_NEAR(measured.volume(), test_support::check_mesh(received.positions, received.triangles).volume, 1e-9);
  request.set_omit_normals(true);
  const ReceivedMesh without = peer_.mesh(request);
  ASSERT_FALSE(received.triangles.empty());
  EXPECT_EQ(received.normals.size(), received.positions.size());
  EXPECT_TRUE(without.normals.empty());
  EXPECT_EQ(without.triangles, received.triangles);
}

TEST_F(Mesh, OfNothingIsEmpty) {
  const v1::Scene apart = test_support::scene_of_nodes(R"(
    {"name": "a", "sphere": {"radius": 1, "range": 1}},
    {"name": "b", "sphere": {"center": [9, 0, 0], "radius": 1, "range": 1}},
    {"min": {"children": ["a", "b"]}})");
  EXPECT_TRUE(peer_.mesh(mesh_request(inlined(apart), 0.1)).triangles.empty());
  v1::MeshRequest request = mesh_request(inlined(ball_.scene()), 0.1);
  for (const double x : {50.0, 50.0, 50.0}) request.add_bounds_min(x);
  for (const double x : {51.0, 51.0, 51.0}) request.add_bounds_max(x);
  EXPECT_TRUE(peer_.mesh(request).triangles.empty());
  request.clear_cells();
  EXPECT_TRUE(peer_.mesh(request).triangles.empty()) << "with a cell size of the server's choice";
}

// Makes a hollow ball with a smaller one inside, and another ball beside it.
v1::Scene hollow_scene() {
  return test_support::scene_of_nodes(R"(
    {"name": "outer", "sphere": {"radius": 1, "range": 0.2}},
    {"name": "hole", "sphere": {"radius": 0.8, "range": 0.2}},
    {"name": "hollow", "difference": {"children": ["outer", "hole"]}},
    {"name": "kernel", "sphere": {"radius": 0.3, "range": 0.2}},
    {"name": "beside", "sphere": {"center": [3, 0, 0], "radius": 0.5, "range": 0.2}},
    {"max": {"children": ["hollow", "kernel", "beside"]}})");
}

TEST_F(Mesh, CountsItsBodiesAndVoidsAndLeavesThemOut) {
  v1::MeshRequest request = mesh_request(inlined(hollow_scene()), 0.05);
  const auto counts = [](const v1::MeshSummary& s) {
    return std::vector<std::uint64_t>{s.bodies(), s.voids(), s.dropped_bodies(), s.dropped_voids()};
  };
  const auto check = [&](const std::vector<std::uint64_t>& expected, double volume) {
    const ReceivedMesh received = peer_.mesh(request);
    expect_sound(received);
    EXPECT_TRUE(received.summary.has_bodies() && received.summary.has_voids());
    EXPECT_EQ(counts(received.summary), expected);
    EXPECT_EQ(counts(peer_.mesh(request).summary), expected) << "kept from before";
    const test_support::MeshReport report = test_support::check_mesh(received.positions, received.triangles);
    EXPECT_EQ(report.components, expected[0] + expected[1]);
    EXPECT_NEAR(report.volume, volume, 0.02 * volume);
    LimitedContext context;
    v1::MeasureResponse measured;
    ASSERT_TRUE(ok(peer_.meshes().Measure(&context, request, &measured)));
    EXPECT_EQ(counts(measured.summary()), expected);
    EXPECT_NEAR(measured.volume(), report.volume, 1e-6);
  };
  const auto ball = [](double r) { return 4.0 / 3 * M_PI * r * r * r; };
  check({3, 1, 0, 0}, ball(1) - ball(0.8) + ball(0.3) + ball(0.5));
  request.set_largest_body(true);
  check({1, 1, 2, 0}, ball(1) - ball(0.8));
  request.set_fill_voids(true);
  check({1, 0, 2, 1}, ball(1));
  request.set_largest_body(false);
  check({2, 0, 1, 1}, ball(1) + ball(0.5));
  request.set_simplification_error(0.005);
  check({2, 0, 1, 1}, ball(1) + ball(0.5));
}

TEST_F(Mesh, TellsTheNormalsOfCreases) {
  // The box's sides lie between the lattice's planes. If an edge ran along a cell's edge, some vertices would be cut
  // off.
  const v1::Scene scene = test_support::scene_of_nodes(R"(
    {"box": {"center": [0, 0, 0], "half_size": [1.03, 0.77, 0.61], "range": 0.5}})");
  auto client = Client::connect(shared_daemon().address());
  ASSERT_TRUE(client.ok()) << client.status();
  v1::MeshRequest request = mesh_request(inlined(scene), 0.1);
  const auto plain = client->mesh(request);
  ASSERT_TRUE(plain.ok()) << plain.status();
  EXPECT_TRUE(plain->creases.vertices.empty());
  request.set_crease_normals(true);
  for (const double error : {0.0, 0.01}) {
    if (error > 0) request.set_simplification_error(error);
    const auto mesh = client->mesh(request);
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    const auto& [vertices, normals, corners] = mesh->creases;
    // There are two wedges along the edges and three at the corners.
    EXPECT_GE(vertices.size(), error > 0 ? 24u : 380u);
    std::vector<float> of_corners;
    for (const std::uint32_t vertex : mesh->triangles) {
      const auto wedge = std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin();
      const bool has_wedge = static_cast<std::size_t>(wedge) < vertices.size();
      const float* normal = has_wedge ? &normals[3 * wedge] : &mesh->normals[3 * std::size_t{vertex}];
      of_corners.insert(of_corners.end(), normal, normal + 3);
    }
    for (std::size_t i = 0; i < corners.size(); i += 2) {
      std::copy_n(&normals[3 * std::size_t{corners[i + 1]}], 3, &of_corners[3 * std::size_t{corners[i]}]);
    }
    for (std::size_t c = 0; c < of_corners.size(); c += 3) {
      const float* n = &of_corners[c];
      EXPECT_NEAR(std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])}), 1, 1e-3) << "that of a side of the box";
    }
    if (error > 0) continue;
    EXPECT_EQ(mesh->positions, plain->positions);
    EXPECT_EQ(mesh->normals, plain->normals);
    EXPECT_EQ(mesh->triangles, plain->triangles);
  }
  request.set_omit_normals(true);
  EXPECT_EQ(client->mesh(request).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(Mesh, SaysWhichPrimitiveIsTooThinForItsCells) {
  v1::Scene scene = test_support::scene_of_nodes(R"(
    {"name": "ball", "sphere": {"center": [3, 0, 0], "radius": 1, "range": 1}},
    {"segment": {"a": [4, 0, 0], "b": [12, 3, 2], "radius_a": 0.1, "radius_b": 0.1, "range": 0.1}},
    {"gradient": {"children": ["ball", "#1"]}})");
  scene.set_unit("mm");
  const ReceivedMesh torn = peer_.mesh(mesh_request(inlined(scene), 0.3));
  EXPECT_GT(torn.summary.bodies(), 1u);
  ASSERT_TRUE(torn.summary.has_too_thin());
  EXPECT_EQ(torn.summary.too_thin().node(), "#1");
  EXPECT_EQ(torn.summary.too_thin().primitives(), 1u);
  EXPECT_NEAR(torn.summary.too_thin().thickness(), 0.2, 1e-9);
  EXPECT_EQ(torn.summary.unit(), "mm");
  const ReceivedMesh whole = peer_.mesh(mesh_request(inlined(scene), torn.summary.too_thin().cell_size()));
  EXPECT_FALSE(whole.summary.has_too_thin());
  EXPECT_EQ(whole.summary.bodies(), 1u);
  const ReceivedMesh none = peer_.mesh(mesh_request(inlined(scene), 1000));
  EXPECT_TRUE(none.triangles.empty());
  EXPECT_EQ(none.summary.bodies(), 0u);
  EXPECT_EQ(none.summary.too_thin().primitives(), 2u);
  // The server's own cells follow the thin primitive by default.
  v1::MeshRequest automatic;
  *automatic.mutable_scene() = inlined(scene);
  const v1::MeshSummary summary = peer_.mesh(automatic).summary;
  EXPECT_EQ(summary.bodies(), 1u);
  EXPECT_FALSE(summary.has_too_thin());
}

TEST_F(Mesh, ReportsProgressThatNeverFalls) {
  const ReceivedMesh received = peer_.mesh(mesh_request(inlined(ball_.scene()), 0.004));
  EXPECT_FALSE(received.progress.empty());
  for (std::size_t i = 0; i < received.progress.size(); ++i) {
    EXPECT_GE(received.progress[i], i == 0 ? 0 : received.progress[i - 1]);
    EXPECT_LE(received.progress[i], 1);
  }
}

TEST(MeshKernels, AreSaidToBeCompiledByTheFirstMeshOfAMixAlone) {
  Daemon daemon;
  Peer peer(daemon.address());
  const v1::MeshRequest request = mesh_request(inlined(Ball().scene()), 0.1);
  EXPECT_TRUE(peer.mesh(request).waited_for_kernels);
  EXPECT_FALSE(peer.mesh(request).waited_for_kernels);
}

TEST_F(Mesh, CostFollowsTheSurface) {
  // The points are small against their box. The number of cells that the server looks at says what they cost.
  const auto cells_of_points = [&](int count) {
    test_support::Random random(11);
    v1::Scene scene;
    v1::Node all;
    for (int i = 0; i < count; ++i) {
      auto* s = scene.add_nodes()->mutable_sphere();
      for (int a = 0; a < 3; ++a) s->add_center(random.number(0, 100));
      s->set_radius(0.4542020 * 0.5);
      s->set_range(0.5457980 * 0.5);
      all.mutable_sum()->add_children(test_support::place(i));
    }
    *scene.add_nodes() = all;
    const ReceivedMesh received = peer_.mesh(mesh_request(inlined(scene), 0.05));
    expect_sound(received);
    return static_cast<double>(received.summary.cells()) / count;
  };
  const double few = cells_of_points(10), many = cells_of_points(1000);
  std::cout << "cells a primitive: " << few << " for 10 points, " << many << " for 1,000\n";
  EXPECT_LE(many, 1.5 * few);
}

}  // namespace
}  // namespace isofield::integration_test
