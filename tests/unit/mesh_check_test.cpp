#include "support/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace isofield::test_support {
namespace {

struct Mesh {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;

  void add(const Mesh& other, float x) {
    const auto base = static_cast<std::uint32_t>(positions.size() / 3);
    for (std::size_t i = 0; i < other.positions.size(); ++i)
      positions.push_back(other.positions[i] + (i % 3 == 0 ? x : 0));
    for (const std::uint32_t i : other.indices) indices.push_back(base + i);
  }
  MeshReport check() const { return check_mesh(positions, indices); }
};

Mesh tetrahedron() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

Mesh torus(int around, int across) {
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.3 * std::cos(v);
      for (const double x : {r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v)}) {
        mesh.positions.push_back(static_cast<float>(x));
      }
      const auto at = [&](int a, int b) { return static_cast<std::uint32_t>(a % around * across + b % across); };
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TEST(MeshCheck, TetrahedronIsSound) {
  const MeshReport r = tetrahedron().check();
  EXPECT_TRUE(r.sound()) << r.text();
  EXPECT_NEAR(r.volume, 1.0 / 6, 1e-12);
  EXPECT_EQ(r.components, 1u);
  EXPECT_EQ(r.euler, 2);
  EXPECT_EQ(r.genus(), 0);
  EXPECT_EQ(r.zero_area, 0u);
}

TEST(MeshCheck, TorusHasOneHandle) {
  const MeshReport r = torus(40, 20).check();
  EXPECT_TRUE(r.sound()) << r.text();
  EXPECT_EQ(r.genus(), 1);
  EXPECT_NEAR(r.volume, 2 * std::numbers::pi * std::numbers::pi * 0.09, 0.05);
}

TEST(MeshCheck, ComponentsAreCounted) {
  Mesh mesh = torus(12, 8);
  mesh.add(tetrahedron(), 5);
  mesh.add(torus(10, 8), 10);
  const MeshReport r = mesh.check();
  EXPECT_TRUE(r.sound()) << r.text();
  EXPECT_EQ(r.components, 3u);
  EXPECT_EQ(r.genus(), 2);
}

TEST(MeshCheck, AHoleIsOpen) {
  Mesh mesh = tetrahedron();
  mesh.indices.resize(9);
  const MeshReport r = mesh.check();
  EXPECT_EQ(r.open_edges, 3u);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, AFlippedTriangleIsFound) {
  Mesh mesh = tetrahedron();
  std::swap(mesh.indices[0], mesh.indices[1]);
  const MeshReport r = mesh.check();
  EXPECT_EQ(r.flipped_edges, 3u);
  EXPECT_FALSE(r.closed());
}

TEST(MeshCheck, AMeshInsideOutHasNegativeVolume) {
  Mesh mesh = tetrahedron();
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) std::swap(mesh.indices[t], mesh.indices[t + 1]);
  const MeshReport r = mesh.check();
  EXPECT_TRUE(r.manifold());
  EXPECT_LT(r.volume, 0);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, ADoubledTriangleCrowdsItsEdges) {
  Mesh mesh = tetrahedron();
  mesh.indices.insert(mesh.indices.end(), {0, 2, 1});
  EXPECT_EQ(mesh.check().crowded_edges, 3u);
}

TEST(MeshCheck, TwoSolidsSharingAnEdgeCrowdIt) {
  // The second tetrahedron lies on the other side of the edge 0-1.
  Mesh mesh = tetrahedron();
  mesh.positions.insert(mesh.positions.end(), {0, -1, 0, 0, 0, -1});
  mesh.indices.insert(mesh.indices.end(), {0, 4, 1, 0, 1, 5, 0, 5, 4, 1, 4, 5});
  const MeshReport r = mesh.check();
  EXPECT_EQ(r.crowded_edges, 1u);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, TwoSolidsSharingAVertexPinchIt) {
  Mesh mesh = tetrahedron();
  mesh.positions.insert(mesh.positions.end(), {-1, 0, 0, 0, -1, 0, 0, 0, -1});
  // The second solid is the mirror image through vertex 0, turned to face outward.
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 3u, 1u, 0u, 2u, 3u, 1u, 3u, 2u}) {
    mesh.indices.push_back(i == 0 ? 0 : i + 3);
  }
  const MeshReport r = mesh.check();
  EXPECT_TRUE(r.closed()) << r.text();
  EXPECT_EQ(r.pinched_vertices, 1u);
  EXPECT_FALSE(r.sound());
}

TEST(MeshCheck, BadTrianglesAreCounted) {
  Mesh mesh = tetrahedron();
  mesh.indices.insert(mesh.indices.end(), {0, 1, 4, 2, 2, 3});
  mesh.positions.insert(mesh.positions.end(), 0, 0.0f);
  MeshReport r = mesh.check();
  EXPECT_EQ(r.bad_indices, 1u);
  EXPECT_EQ(r.degenerate_triangles, 1u);
  EXPECT_FALSE(r.sound());
  EXPECT_TRUE(r.manifold());

  mesh = tetrahedron();
  mesh.positions[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(mesh.check().not_finite, 1u);
  EXPECT_FALSE(mesh.check().sound());
}

TEST(MeshCheck, FlatTrianglesAreCounted) {
  Mesh mesh = tetrahedron();
  mesh.positions[9] = 0.5f, mesh.positions[10] = 0.5f, mesh.positions[11] = 0;  // vertex 3 onto the edge 1-2
  EXPECT_EQ(mesh.check().zero_area, 1u);
}

TEST(MeshCheck, UnusedVerticesAreNoComponents) {
  Mesh mesh = tetrahedron();
  mesh.positions.insert(mesh.positions.end(), {7, 7, 7});
  const MeshReport r = mesh.check();
  EXPECT_EQ(r.unused_vertices, 1u);
  EXPECT_EQ(r.components, 1u);
  EXPECT_TRUE(r.sound());
}

TEST(MeshCheck, AnEmptyMeshIsNotSound) {
  EXPECT_FALSE(check_mesh({}, {}).sound());
}

TEST(MeshCheck, OneMillionTriangles) {
  const MeshReport r = torus(1000, 600).check();
  EXPECT_EQ(r.triangles, 1'200'000u);
  EXPECT_TRUE(r.sound()) << r.text();
  EXPECT_EQ(r.genus(), 1);
}

}  // namespace
}  // namespace isofield::test_support
