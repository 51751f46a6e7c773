#include "engine/mesh/crease_wedges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "support/cube_grid.h"

namespace isofield::engine {
namespace {

void add_point(Mesh& mesh, double x, double y, double z) {
  for (const double a : {x, y, z}) mesh.positions.push_back(static_cast<float>(a));
}

// Wedges name the mesh's own vertices, and those below the number of vertices bear their vertex's number.
void expect_sound(const Mesh& mesh, const CreaseWedges& wedges) {
  const std::size_t vertices = mesh.positions.size() / 3;
  ASSERT_GE(wedges.vertices.size(), vertices);
  for (std::uint32_t w = 0; w < vertices; ++w) EXPECT_EQ(wedges.vertices[w], w);
  ASSERT_EQ(3 * wedges.triangles.size(), mesh.triangles.size());
  std::set<std::uint32_t> used;
  for (std::size_t c = 0; c < mesh.triangles.size(); ++c) {
    const std::uint32_t wedge = wedges.triangles[c / 3][c % 3];
    EXPECT_EQ(wedges.vertices.at(wedge), mesh.triangles[c]);
    used.insert(wedge);
  }
  EXPECT_EQ(used.size(), wedges.vertices.size());
}

TEST(CreaseWedges, ACubeIsCutAlongItsEdges) {
  for (const int n : {1, 2, 5}) {
    SCOPED_TRACE(n);
    const test_support::CubeGrid grid = test_support::cube_grid(n);
    Mesh mesh{.triangles = grid.triangles};
    for (const auto& p : grid.places) add_point(mesh, p[0], p[1], p[2]);
    const CreaseWedges wedges = crease_wedges(mesh);
    expect_sound(mesh, wedges);
    // There are three at each corner, two within edges, and one within sides.
    EXPECT_EQ(wedges.vertices.size(), 8u * 3 + 12u * 2 * (n - 1) + 6u * (n - 1) * (n - 1));
    // A wedge lies in one side of the cube.
    std::map<std::uint32_t, std::size_t> sides;
    for (std::size_t t = 0; t < wedges.triangles.size(); ++t) {
      const std::size_t side = t / (2u * n * n);  // cube_grid makes one side after the other
      for (const std::uint32_t wedge : wedges.triangles[t]) {
        EXPECT_EQ(sides.try_emplace(wedge, side).first->second, side);
      }
    }
  }
}

// A strip of two rows of squares, folded by an angle along the line between the rows.
Mesh folded_strip(double degrees, int length) {
  const double half = degrees / 2 * std::numbers::pi / 180;
  Mesh mesh;
  for (int i = 0; i <= length; ++i) {
    add_point(mesh, -std::cos(half), i, -std::sin(half));
    add_point(mesh, 0, i, 0);
    add_point(mesh, std::cos(half), i, -std::sin(half));
    if (i == 0) continue;
    const auto at = static_cast<std::uint32_t>(3 * i);
    for (const std::uint32_t a : {at - 3, at - 2}) {
      for (const std::uint32_t corner : {a, a + 1, a + 4, a, a + 4, a + 3}) mesh.triangles.push_back(corner);
    }
  }
  return mesh;
}

TEST(CreaseWedges, AFoldIsACreaseFrom25Degrees) {
  constexpr int kLength = 6;
  for (const double degrees : {-26.0, 26.0, 90.0, 150.0}) {
    const Mesh mesh = folded_strip(degrees, kLength);
    const CreaseWedges wedges = crease_wedges(mesh);
    expect_sound(mesh, wedges);
    EXPECT_EQ(wedges.vertices.size(), 3u * (kLength + 1) + kLength + 1) << degrees;
  }
  for (const double degrees : {-24.0, 0.0, 24.0}) {
    const Mesh mesh = folded_strip(degrees, kLength);
    const CreaseWedges wedges = crease_wedges(mesh);
    expect_sound(mesh, wedges);
    EXPECT_EQ(wedges.vertices.size(), mesh.positions.size() / 3) << degrees;
  }
}

TEST(CreaseWedges, ASingleEdgeCutsNothing) {
  // The triangles turn by 28 degrees at the edge between the first two vertices, and by 23 or less at all others.
  Mesh mesh{.triangles = {0, 1, 2, 0, 3, 1, 0, 2, 4, 0, 4, 3, 1, 5, 2, 1, 3, 5}};
  add_point(mesh, 0, 0, 0);
  add_point(mesh, 1, 0, 0);
  add_point(mesh, 0.5, 1, -0.25);
  add_point(mesh, 0.5, -1, -0.25);
  add_point(mesh, -1, 0, 0.1);
  add_point(mesh, 2, 0, 0.1);
  const CreaseWedges wedges = crease_wedges(mesh);
  expect_sound(mesh, wedges);
  EXPECT_EQ(wedges.vertices.size(), 6u);
  // If the fold continues to the border, the vertex between and the one at the border have two wedges each.
  mesh.positions[3 * 4 + 2] = 0;
  const CreaseWedges longer = crease_wedges(mesh);
  expect_sound(mesh, longer);
  EXPECT_EQ(std::vector<std::uint32_t>(longer.vertices.begin() + 6, longer.vertices.end()),
            (std::vector<std::uint32_t>{0, 4}));
}

TEST(CreaseWedges, OfNothingAreNone) {
  const CreaseWedges wedges = crease_wedges(Mesh());
  EXPECT_TRUE(wedges.vertices.empty());
  EXPECT_TRUE(wedges.triangles.empty());
}

}  // namespace
}  // namespace isofield::engine
