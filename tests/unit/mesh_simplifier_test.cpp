#include "engine/simplify/mesh_simplifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "blobtree/geometry/vec3.h"
#include "support/cube_grid.h"
#include "support/mesh_check.h"

namespace isofield::engine {
namespace {

using blobtree::dvec3;
using test_support::check_mesh;

dvec3 at(const Mesh& mesh, std::uint32_t vertex) {
  const float* p = &mesh.positions[3 * std::size_t{vertex}];
  return {p[0], p[1], p[2]};
}

// Makes the surface of the cube [-1, 1]^3 with n squares along each edge; `move` says where its vertices go.
template <class Move>
Mesh cube(int n, const Move& move) {
  const test_support::CubeGrid grid = test_support::cube_grid(n);
  Mesh mesh{.triangles = grid.triangles};
  for (const auto& place : grid.places) {
    const dvec3 p = move(dvec3{place[0], place[1], place[2]}), normal = p * (1 / length(p));
    for (const double x : {p.x, p.y, p.z}) mesh.positions.push_back(static_cast<float>(x));
    for (const double x : {normal.x, normal.y, normal.z}) mesh.normals.push_back(static_cast<float>(x));
  }
  return mesh;
}
Mesh cube(int n) {
  return cube(n, [](const dvec3& p) { return p; });
}
Mesh ball(int n) {
  return cube(n, [](const dvec3& p) {
    const dvec3 q{std::tan(p.x * 0.785), std::tan(p.y * 0.785), std::tan(p.z * 0.785)};
    return q * (1 / length(q));
  });
}

Mesh torus(int around, int across, double minor) {
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + minor * std::cos(v);
      for (const double x : {r * std::cos(u), r * std::sin(u), minor * std::sin(v)}) {
        mesh.positions.push_back(static_cast<float>(x));
      }
      const auto number = [&](int a, int b) { return static_cast<std::uint32_t>(a % around * across + b % across); };
      mesh.triangles.insert(mesh.triangles.end(), {number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.triangles.insert(mesh.triangles.end(), {number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  return mesh;
}

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - a - (b - a) * t);
}

// Returns the distance of p from all triangles, whichever way they face.
double distance(const dvec3& p, const Mesh& mesh) {
  double least = 1e30;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const dvec3 a = at(mesh, mesh.triangles[t]), b = at(mesh, mesh.triangles[t + 1]),
                c = at(mesh, mesh.triangles[t + 2]);
    least = std::min({least, distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
    // These are the barycentric coordinates of p's foot.
    const dvec3 u = b - a, v = c - a, w = p - a, n = cross(u, v);
    const double area2 = dot(n, n), beta = dot(cross(w, v), n) / area2, gamma = dot(cross(u, w), n) / area2;
    if (beta >= 0 && gamma >= 0 && beta + gamma <= 1) least = std::min(least, std::abs(dot(w, n)) / std::sqrt(area2));
  }
  return least;
}

// Checks all that simplify() promises, by trying every pair of a vertex and a triangle.
Mesh expect_simplified(const Mesh& mesh, double error) {
  const absl::StatusOr<Mesh> simplified = simplify(mesh, error, {});
  EXPECT_TRUE(simplified.ok()) << simplified.status();
  const test_support::MeshReport before = check_mesh(mesh.positions, mesh.triangles);
  const test_support::MeshReport after = check_mesh(simplified->positions, simplified->triangles);
  EXPECT_TRUE(after.sound()) << after.text();
  EXPECT_EQ(after.zero_area, 0u);
  EXPECT_EQ(after.unused_vertices, 0u);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.genus(), before.genus());
  EXPECT_EQ(simplified->normals.size(), mesh.normals.empty() ? 0 : simplified->positions.size());

  std::map<std::array<float, 3>, std::size_t> numbers;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    numbers[{mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]}] = i;
  }
  for (std::size_t i = 0; i < simplified->positions.size(); i += 3) {
    const float* p = &simplified->positions[i];
    const auto found = numbers.find({p[0], p[1], p[2]});
    EXPECT_TRUE(found != numbers.end()) << "a vertex that was not there";
    if (found == numbers.end() || mesh.normals.empty()) continue;
    EXPECT_EQ(std::memcmp(&mesh.normals[found->second], &simplified->normals[i], 3 * sizeof(float)), 0);
  }
  double worst = 0, back = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size() / 3; ++v)
    worst = std::max(worst, distance(at(mesh, v), *simplified));
  for (std::size_t t = 0; t < simplified->triangles.size(); t += 3) {
    const auto& v = simplified->triangles;
    const dvec3 middle = (at(*simplified, v[t]) + at(*simplified, v[t + 1]) + at(*simplified, v[t + 2])) * (1.0 / 3);
    back = std::max(back, distance(middle, mesh));
  }
  std::cout << "error " << error << ": " << before.triangles << " triangles become " << after.triangles
            << "; vertices within " << worst << " of them, their middles within " << back << "\n";
  EXPECT_LE(worst, error * (1 + 1e-9));
  EXPECT_LE(back, 1.2 * error);  // the middles are not among the points that simplify() looks at
  return *simplified;
}

TEST(MeshSimplifier, KeepsABallWithinTheError) {
  const Mesh mesh = ball(24);
  std::size_t last = mesh.triangles.size();
  for (const double error : {4e-3, 8e-3, 2e-2}) {
    const Mesh simplified = expect_simplified(mesh, error);
    EXPECT_LT(simplified.triangles.size(), last);
    last = simplified.triangles.size();
    for (std::size_t t = 0; t < simplified.triangles.size(); t += 3) {
      const dvec3 a = at(simplified, simplified.triangles[t]), b = at(simplified, simplified.triangles[t + 1]),
                  c = at(simplified, simplified.triangles[t + 2]);
      EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0) << "turned over";
    }
  }
  EXPECT_LT(last, mesh.triangles.size() / 8);
}

TEST(MeshSimplifier, KeepsTheCreasesOfACube) {
  const Mesh mesh = cube(20);
  const Mesh simplified = expect_simplified(mesh, 0.01);
  EXPECT_LT(simplified.triangles.size(), mesh.triangles.size() / 10);
  EXPECT_NEAR(check_mesh(simplified.positions, simplified.triangles).volume, 8, 1e-6);
  // If triangles of two sides meet, both ends of their edge lie on the cube's edge.
  std::size_t corners = 0;
  for (std::uint32_t v = 0; v < simplified.positions.size() / 3; ++v) {
    const dvec3 p = at(simplified, v);
    corners += std::abs(p.x) == 1 && std::abs(p.y) == 1 && std::abs(p.z) == 1;
  }
  EXPECT_EQ(corners, 8u);
  for (std::size_t t = 0; t < simplified.triangles.size(); t += 3) {
    const dvec3 a = at(simplified, simplified.triangles[t]), b = at(simplified, simplified.triangles[t + 1]),
                c = at(simplified, simplified.triangles[t + 2]);
    const dvec3 n = cross(b - a, c - a) * (1 / length(cross(b - a, c - a)));
    EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-9) << "across a crease";
  }
}

TEST(MeshSimplifier, KeepsHandlesOfThinParts) {
  // The errors go beyond the thickness, where a simplification without checks would close or part the torus.
  for (const double error : {1e-3, 0.02, 0.05, 0.2, 3.0}) expect_simplified(torus(90, 8, 0.05), error);
}

TEST(MeshSimplifier, KeepsPartsThatTouchNearly) {
  Mesh mesh = ball(10);
  const Mesh other = mesh;
  const auto base = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  for (std::size_t i = 0; i < other.positions.size(); ++i) {
    mesh.positions.push_back(other.positions[i] + (i % 3 == 0 ? 2.001f : 0));
  }
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const std::uint32_t v : other.triangles) mesh.triangles.push_back(base + v);
  for (const double error : {0.01, 0.3}) expect_simplified(mesh, error);
}

TEST(MeshSimplifier, TakesErrorsOfAnySize) {
  const Mesh mesh = ball(8);
  expect_simplified(mesh, 1e9);
  const auto same = simplify(mesh, 1e-30, {});
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->triangles.size(), mesh.triangles.size());
  const auto nothing = simplify(Mesh(), 1, {});
  ASSERT_TRUE(nothing.ok());
  EXPECT_TRUE(nothing->triangles.empty());
}

TEST(MeshSimplifier, IsDeterministic) {
  const Mesh mesh = ball(20);
  const auto a = simplify(mesh, 0.01, {}), b = simplify(mesh, 0.01, {});
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a->triangles, b->triangles);
  EXPECT_EQ(a->positions, b->positions);
  EXPECT_EQ(a->normals, b->normals);
}

TEST(MeshSimplifier, StopsWhenCancelledAndReportsProgress) {
  const Mesh mesh = ball(60);
  int asked = 0;
  const auto cancelled = simplify(mesh, 0.01, {.cancelled = [&] { return ++asked > 6; }});
  EXPECT_EQ(cancelled.status().code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(asked, 7);
  double last = 0;
  ASSERT_TRUE(simplify(mesh, 0.01,
                       {.progress =
                            [&](double fraction) {
                              EXPECT_GE(fraction, last);
                              EXPECT_LE(fraction, 1);
                              last = fraction;
                            }})
                  .ok());
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace isofield::engine
