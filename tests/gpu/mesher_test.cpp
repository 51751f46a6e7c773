// Tests meshes made on the device.
#include "engine/mesh/mesher.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <vector>

#include "base/limits.h"
#include "engine/mesh/cell_size.h"
#include "engine/mesh/surface_cases.h"
#include "engine/simplify/mesh_simplifier.h"
#include "gpu/gpu_environment.h"
#include "reference/evaluator.h"
#include "support/mesh_check.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using engine::Mesh;
using engine::MeshRequest;

absl::StatusOr<Mesh> mesh(const v1::Scene& scene, const MeshRequest& request,
                          const engine::MeshCallbacks& callbacks = {},
                          std::optional<engine::ShellCounts>* shells = nullptr) {
  static engine::Mesher mesher(device(), kernels(), workers());
  return mesher.mesh(*resident(scene), request, callbacks, shells);
}

// Counts vertices that are far from the surface (in cells, by the linearised distance) and normals that do not follow
// the gradient.
void expect_on_surface(const Mesh& m, const v1::Scene& scene, double cell, double iso = 0.5) {
  const reference::Evaluator exact(test_support::read_or_die(scene));
  double worst = 0;
  std::size_t off = 0, turned = 0;
  const std::size_t count = m.positions.size() / 3, step = std::max<std::size_t>(count / 5000, 1);
  for (std::size_t v = 0; v < count; v += step) {
    const reference::Sample s = exact.evaluate({m.positions[3 * v], m.positions[3 * v + 1], m.positions[3 * v + 2]});
    const double slope = length(s.gradient);
    const double distance = std::abs(s.value - iso) / slope / cell;
    worst = std::max(worst, distance);
    off += !(distance <= 0.01);
    const double cosine =
        -(s.gradient.x * m.normals[3 * v] + s.gradient.y * m.normals[3 * v + 1] + s.gradient.z * m.normals[3 * v + 2]) /
        slope;
    turned += !(cosine > 0.99);
  }
  std::cout << count << " vertices, furthest " << worst << " cells off the surface\n";
  EXPECT_EQ(off, 0u);
  EXPECT_EQ(turned, 0u);
}

v1::Scene sphere_scene() {
  return test_support::scene_of_nodes(R"([{"sphere": {"center": [0.1, 0.2, -0.3], "radius": 1, "range": 0.5}}])");
}

v1::Scene blend_scene() {
  return test_support::scene_of_nodes(R"([
    {"name": "a", "segment": {"a": [-1, 0, 0], "b": [1, 0, 0], "radius_a": 0.3, "radius_b": 0.2, "range": 0.3}},
    {"name": "b", "segment": {"a": [0, -1, 0], "b": [0, 1, 0], "radius_a": 0.25, "radius_b": 0.25, "range": 0.25}},
    {"name": "c", "segment": {"a": [0, 0, 0], "b": [0.5, 0.5, 1], "radius_a": 0.25, "radius_b": 0.1, "range": 0.25}},
    {"name": "t", "torus": {"major_radius": 0.8, "minor_radius": 0.15, "range": 0.2}},
    {"gradient": {"children": ["a", "b", "c", "t"]}}])");
}

TEST(SurfaceCases, HaveAtMostOneDoubtfulFace) {
  for (int c = 0; c < 256; ++c) {
    const engine::SurfaceCase& plain = engine::surface_cases()[c];
    EXPECT_LE(plain.patches, 4);
    const engine::SurfaceCase& flipped = engine::surface_cases()[256 + c];
    if (plain.doubtful_face >= 0) {
      EXPECT_EQ(flipped.doubtful_face, -1) << "case " << c << " stays doubtful when resolved the other way";
    }
  }
}

TEST(Mesher, MakesASphereOfTheRightVolume) {
  const auto m = mesh(sphere_scene(), {.cell_size = 0.05});
  ASSERT_TRUE(m.ok()) << m.status();
  const test_support::MeshReport report = test_support::check_mesh(m->positions, m->triangles);
  EXPECT_TRUE(report.sound()) << report.text();
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus(), 0);
  EXPECT_NEAR(report.volume, 4.0 / 3 * M_PI, 0.01);
  EXPECT_EQ(report.zero_area, 0u);
  expect_on_surface(*m, sphere_scene(), 0.05);
}

TEST(Mesher, IsDeterministic) {
  const v1::Scene scene = test_support::random_scene(3, {.nodes = 60});
  const auto a = mesh(scene, {.cell_size = 0.07}), b = mesh(scene, {.cell_size = 0.07});
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a->triangles, b->triangles);
  ASSERT_EQ(a->positions.size(), b->positions.size());
  EXPECT_EQ(std::memcmp(a->positions.data(), b->positions.data(), 4 * a->positions.size()), 0);
  EXPECT_EQ(std::memcmp(a->normals.data(), b->normals.data(), 4 * a->normals.size()), 0);
}

std::optional<blobtree::Box> bounds_if_needed(const v1::Scene& scene) {
  const auto support = resident(scene)->tape().support;
  if (support.empty() || support.max.x < base::kMaxCoordinate) return std::nullopt;
  return blobtree::Box{{-2, -2, -2}, {2, 2, 2}};
}

TEST(Mesher, MakesManifoldsOfRandomScenes) {
  for (const int nodes : {3, 10, 40, 120}) {
    for (std::uint64_t seed = 0; seed < scene_count(6); ++seed) {
      const v1::Scene scene = test_support::random_scene(50 * nodes + seed, {.nodes = nodes});
      // Coarse cells against small features are the hard case for topology.
      for (const double cell : {0.31, 0.11, 0.05}) {
        // A field that operators make more than 0 everywhere needs bounds.
        const auto m = mesh(scene, {.cell_size = cell, .bounds = bounds_if_needed(scene)});
        ASSERT_TRUE(m.ok()) << m.status();
        if (m->triangles.empty()) continue;
        const test_support::MeshReport report = test_support::check_mesh(m->positions, m->triangles);
        EXPECT_TRUE(report.sound()) << nodes << " nodes, seed " << seed << ", cell " << cell << ": " << report.text();
      }
    }
  }
}

TEST(Mesher, MakesManifoldsThatStayThatSimplified) {
  for (const int nodes : {10, 120}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const v1::Scene scene = test_support::random_scene(50 * nodes + seed, {.nodes = nodes});
      const double cell = 0.06;
      const auto m = mesh(scene, {.cell_size = cell, .bounds = bounds_if_needed(scene)});
      ASSERT_TRUE(m.ok()) << m.status();
      if (m->triangles.empty()) continue;
      const test_support::MeshReport before = test_support::check_mesh(m->positions, m->triangles);
      for (const double error : {0.1, 2.0}) {
        const auto simplified = engine::simplify(*m, error * cell, {});
        ASSERT_TRUE(simplified.ok()) << simplified.status();
        const test_support::MeshReport after = test_support::check_mesh(simplified->positions, simplified->triangles);
        EXPECT_TRUE(after.sound()) << nodes << " nodes, seed " << seed << ", error " << error << ": " << after.text();
        EXPECT_EQ(after.components, before.components) << nodes << " nodes, seed " << seed << ", error " << error;
        EXPECT_EQ(after.genus(), before.genus()) << nodes << " nodes, seed " << seed << ", error " << error;
        EXPECT_LE(after.zero_area, before.zero_area);
      }
    }
  }
}

TEST(Mesher, MakesManifoldsOfNoise) {
  // The balls are about as large as a cell, so every case of the tables occurs, even doubtful faces next to one
  // another.
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    test_support::Random random(seed);
    v1::Scene scene;
    v1::Node all;
    for (int i = 0; i < 9000; ++i) {
      auto* s = scene.add_nodes()->mutable_sphere();
      for (int a = 0; a < 3; ++a) s->add_center(random.number(0, 24));
      s->set_radius(0.45);
      s->set_range(0.2);
      all.mutable_max()->add_children(test_support::place(i));
    }
    *scene.add_nodes() = all;
    const auto m = mesh(scene, {.cell_size = 1});
    ASSERT_TRUE(m.ok()) << m.status();
    const test_support::MeshReport report = test_support::check_mesh(m->positions, m->triangles);
    std::cout << report.text() << "\n";
    EXPECT_TRUE(report.manifold()) << report.text();
    EXPECT_GT(report.triangles, 10'000u);
  }
}

TEST(Mesher, KeepsVerticesOnTheSurfaceOfBlends) {
  const v1::Scene scene = blend_scene();
  for (const double cell : {0.1, 0.04}) {
    const auto m = mesh(scene, {.cell_size = cell});
    ASSERT_TRUE(m.ok()) << m.status();
    const test_support::MeshReport report = test_support::check_mesh(m->positions, m->triangles);
    EXPECT_TRUE(report.sound()) << report.text();
    expect_on_surface(*m, scene, cell);
  }
}

TEST(Mesher, BringsVerticesAsNearAsTheToleranceSays) {
  const v1::Scene scene = blend_scene();
  const reference::Evaluator exact(test_support::read_or_die(scene));
  const double cell = 0.02;
  double last = 1;
  for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const auto m = mesh(scene, {.cell_size = cell, .tolerance = tolerance});
    ASSERT_TRUE(m.ok()) << m.status();
    EXPECT_TRUE(test_support::check_mesh(m->positions, m->triangles).sound());
    std::vector<double> distances;
    for (std::size_t v = 0; v < m->positions.size(); v += 12) {
      const reference::Sample s = exact.evaluate({m->positions[v], m->positions[v + 1], m->positions[v + 2]});
      distances.push_back(std::abs(s.value - 0.5) / length(s.gradient) / cell);
    }
    std::sort(distances.begin(), distances.end());
    // If the surface runs along a face of a cell, its vertices keep off that face, whatever the tolerance is.
    const double most = distances[distances.size() * 97 / 100];
    std::cout << "tolerance " << tolerance << ": 97 % within " << most << ", the furthest " << distances.back() << "\n";
    EXPECT_LE(most, 1.5 * tolerance);
    EXPECT_LE(distances.back(), 1.1 * std::max(tolerance, 4e-3));
    EXPECT_LT(most, last);
    last = most;
  }
}

TEST(Mesher, ClosesTheMeshAtStatedBounds) {
  const MeshRequest request{.cell_size = 0.06, .bounds = blobtree::Box{{-2, -2, -2}, {0.1, 2, 2}}};
  const auto m = mesh(sphere_scene(), request);
  ASSERT_TRUE(m.ok()) << m.status();
  const test_support::MeshReport report = test_support::check_mesh(m->positions, m->triangles);
  EXPECT_TRUE(report.sound()) << report.text();
  EXPECT_NEAR(report.volume, 2.0 / 3 * M_PI, 0.25);
  for (std::size_t v = 0; v < m->positions.size(); v += 3) EXPECT_LE(m->positions[v], 0.1 + 1e-6);
}

TEST(Mesher, GivesNothingForNothing) {
  const v1::Scene scene = test_support::scene_of_nodes(R"([
    {"name": "a", "sphere": {"radius": 0.3, "range": 0.3}},
    {"name": "b", "sphere": {"center": [5, 0, 0], "radius": 0.3, "range": 0.3}},
    {"min": {"children": ["a", "b"]}}])");
  const auto m = mesh(scene, {.cell_size = 0.1});
  ASSERT_TRUE(m.ok()) << m.status();
  EXPECT_TRUE(m->positions.empty());
  EXPECT_TRUE(m->triangles.empty());
}

TEST(Mesher, StatesTheSmallestCellThatFits) {
  MeshRequest request{.cell_size = 1e-3, .max_cells = 100'000};
  const auto refused = mesh(sphere_scene(), request);
  ASSERT_EQ(refused.status().code(), absl::StatusCode::kResourceExhausted) << refused.status();
  const std::string text(refused.status().message());
  const std::size_t at = text.rfind(' ');
  request.cell_size = std::stod(text.substr(at));
  EXPECT_TRUE(mesh(sphere_scene(), request).ok()) << text;
  request.cell_size *= 0.9;
  EXPECT_FALSE(mesh(sphere_scene(), request).ok()) << text;
}

// A ball of the radius holds a corner of a cell wherever it lies (engine/mesh/cell_size.h).
TEST(Mesher, KeepsThinChainsWholeAtTheCoarsestCellThatIsSaidToDo) {
  constexpr double kRadius = 0.1;
  int torn = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    test_support::Random random(seed);
    std::string nodes, names;
    blobtree::dvec3 at = random.point(-1, 1);
    for (int i = 0; i < 60; ++i) {
      blobtree::dvec3 step = random.point(-1, 1);
      // Some rods run along faces and diagonals of the cells, where samples are farthest apart.
      if (i % 3 == 0) step = {std::round(step.x), std::round(step.y), 0.5};
      const blobtree::dvec3 next = at + step * (0.7 / std::max(length(step), 0.1));
      absl::StrAppend(&nodes, R"({"segment": {"a": [)", at.x, ",", at.y, ",", at.z, R"(], "b": [)", next.x, ",", next.y,
                      ",", next.z, R"(], "radius_a": 0.1, "radius_b": 0.1, "range": 0.05}},)");
      absl::StrAppend(&names, i == 0 ? "" : ",", "\"#", i, "\"");
      at = next;
    }
    const v1::Scene scene =
        test_support::scene_of_nodes(absl::StrCat(nodes, R"({"max": {"children": [)", names, "]}}"));
    const auto bodies = [&](double cells_of_radius) {
      std::optional<engine::ShellCounts> shells;
      const auto made = mesh(scene, {.cell_size = cells_of_radius * kRadius}, {}, &shells);
      EXPECT_TRUE(made.ok()) << made.status();
      return shells ? shells->bodies : 0;
    };
    EXPECT_EQ(bodies(engine::kCoarsestCellOfRadius), 1u) << "seed " << seed;
    torn += bodies(1.4) > 1;
  }
  EXPECT_GT(torn, 3) << "chains that coarser cells tear: else this test says little";
}

TEST(Mesher, StopsWhenCancelled) {
  int asked = 0;
  const engine::MeshCallbacks callbacks{.cancelled = [&] { return ++asked > 2; }};
  const auto m = mesh(sphere_scene(), {.cell_size = 0.02}, callbacks);
  EXPECT_EQ(m.status().code(), absl::StatusCode::kCancelled);
}

TEST(Mesher, ReportsProgressThatNeverFalls) {
  double last = 0;
  const engine::MeshCallbacks callbacks{.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  }};
  ASSERT_TRUE(mesh(sphere_scene(), {.cell_size = 0.02}, callbacks).ok());
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace isofield::gpu_test
