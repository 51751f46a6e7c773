#include "engine/mesh/crease_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "engine/mesh/crease_wedges.h"
#include "support/cube_grid.h"

namespace isofield::engine {
namespace {

// Makes a cube whose vertices on edges have the normal of one of their sides, as a field's gradient has.
Mesh cube(int n) {
  const test_support::CubeGrid grid = test_support::cube_grid(n);
  Mesh mesh{.triangles = grid.triangles};
  for (const auto& place : grid.places) {
    for (const double x : place) mesh.positions.push_back(static_cast<float>(x));
  }
  for (const auto& side : grid.sides) {
    for (const double x : side) mesh.normals.push_back(static_cast<float>(x));
  }
  return mesh;
}

// The wedge of each corner, or kNone if the corner's vertex has none.
constexpr std::uint32_t kNone = ~0u;
std::vector<std::uint32_t> wedges_of(const Mesh& mesh, const CreaseNormals& creases) {
  std::map<std::uint32_t, std::uint32_t> first;
  for (std::uint32_t wedge = 0; wedge < creases.vertices.size(); ++wedge) {
    first.try_emplace(creases.vertices[wedge], wedge);
  }
  std::vector<std::uint32_t> wedges;
  for (const std::uint32_t vertex : mesh.triangles) wedges.push_back(first.contains(vertex) ? first[vertex] : kNone);
  for (std::size_t i = 0; i < creases.corners.size(); i += 2) {
    const std::uint32_t corner = creases.corners[i], wedge = creases.corners[i + 1];
    EXPECT_EQ(creases.vertices.at(wedge), mesh.triangles.at(corner));
    EXPECT_NE(wedge, wedges[corner]) << "the first wedge needs no name";
    wedges[corner] = wedge;
  }
  return wedges;
}

TEST(CreaseNormals, OfACubeAreThoseOfItsSides) {
  for (const int n : {1, 8}) {
    const Mesh mesh = cube(n);
    const CreaseNormals creases = crease_normals(mesh);
    // The 8 corners and the vertices within the 12 edges have a wedge for each side.
    EXPECT_EQ(creases.vertices.size(), 8u * 3 + 12u * 2 * (n - 1));
    ASSERT_EQ(creases.normals.size(), 3 * creases.vertices.size());
    const std::vector<std::uint32_t> wedges = wedges_of(mesh, creases);
    for (std::size_t c = 0; c < wedges.size(); ++c) {
      const float* p = &mesh.positions[3 * std::size_t{mesh.triangles[c]}];
      const int sides = (std::abs(p[0]) == 1) + (std::abs(p[1]) == 1) + (std::abs(p[2]) == 1);
      EXPECT_EQ(wedges[c] == kNone, sides == 1);
      if (wedges[c] == kNone) continue;
      // The loop finds the side that the triangle lies in.
      const std::size_t t = c / 3 * 3;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](std::size_t i) { return mesh.positions[3 * std::size_t{mesh.triangles[t + i]} + axis]; };
        if (at(0) != at(1) || at(0) != at(2)) continue;
        EXPECT_EQ(creases.normals[3 * std::size_t{wedges[c]} + axis], at(0));
      }
    }
  }
}

TEST(CreaseNormals, WedgesComeInTheOrderOfTheirFirstCorners) {
  const Mesh mesh = cube(3);
  const std::vector<std::uint32_t> wedges = wedges_of(mesh, crease_normals(mesh));
  std::set<std::uint32_t> seen;
  for (const std::uint32_t wedge : wedges) {
    if (wedge == kNone) continue;
    if (seen.insert(wedge).second) {
      EXPECT_EQ(wedge, seen.size() - 1);
    }
  }
}

Mesh torus(int around, int across) {
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      for (const double x : {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)}) {
        mesh.normals.push_back(static_cast<float>(x));
      }
      const double r = 3 + std::cos(v);
      for (const double x : {r * std::cos(u), r * std::sin(u), std::sin(v)}) {
        mesh.positions.push_back(static_cast<float>(x));
      }
      const auto number = [&](int a, int b) { return static_cast<std::uint32_t>(a % around * across + b % across); };
      mesh.triangles.insert(mesh.triangles.end(), {number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.triangles.insert(mesh.triangles.end(), {number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  return mesh;
}

TEST(CreaseNormals, CoarseCurvedSidesHaveNone) {
  EXPECT_TRUE(crease_normals(torus(40, 20)).vertices.empty());
  // Neighbouring triangles turn by 45 degrees. The normals show that these are no creases; without normals the mesh
  // would be cut.
  const Mesh coarse = torus(10, 8);
  EXPECT_TRUE(crease_normals(coarse).vertices.empty());
  EXPECT_GT(crease_wedges(coarse).vertices.size(), coarse.positions.size() / 3);
}

// Makes a strip folded along its middle. The triangles there turn alternately by 5 degrees more and less than the fold,
// as on curved sides. The sides' normals are exact; the normals along the fold are those of either side, or the mean.
Mesh folded_strip(double degrees, int length, bool has_mean_normals) {
  const double half = degrees / 2 * std::numbers::pi / 180, lean = 2.5 * std::numbers::pi / 180;
  Mesh mesh;
  const auto add = [&](double x, double y, double z, double turn) {
    for (const double value : {x, y, z}) mesh.positions.push_back(static_cast<float>(value));
    for (const double value : {std::sin(turn), 0.0, std::cos(turn)}) {
      mesh.normals.push_back(static_cast<float>(value));
    }
  };
  for (int i = 0; i <= length; ++i) {
    const double leaning = i % 4 < 2 ? half + lean : half - lean;
    add(-std::cos(leaning), i, -std::sin(leaning), -half);
    add(0, i, 0, has_mean_normals ? 0 : i % 3 == 0 ? half : -half);
    add(std::cos(leaning), i, -std::sin(leaning), half);
    if (i == 0) continue;
    const auto at = static_cast<std::uint32_t>(3 * i);
    for (const std::uint32_t a : {at - 3, at - 2}) {
      for (const std::uint32_t corner : {a, a + 1, a + 4, a, a + 4, a + 3}) mesh.triangles.push_back(corner);
    }
  }
  return mesh;
}

TEST(CreaseNormals, CreasesGoOnWhereTrianglesLean) {
  const int length = 20;
  // Only one edge of the crease meets a vertex at either end. The other vertices have two wedges each.
  EXPECT_EQ(crease_normals(folded_strip(27, length, false)).vertices.size(), 2u * (length - 1));
  // The mesher gives mean normals to sides that are to be shaded as one.
  EXPECT_TRUE(crease_normals(folded_strip(24, length, true)).vertices.empty());
  EXPECT_TRUE(crease_normals(folded_strip(18, length, false)).vertices.empty());
}

TEST(CreaseNormals, OfNothingAreNone) {
  EXPECT_TRUE(crease_normals(Mesh()).vertices.empty());
}

}  // namespace
}  // namespace isofield::engine
