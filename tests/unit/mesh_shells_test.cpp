#include "engine/mesh/mesh_shells.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include "support/cube_grid.h"
#include "support/mesh_check.h"

namespace isofield::engine {
namespace {

// Adds a cube with edges of 2 * half around (x, 0, 0). It faces inward if it is a void.
void add_cube(Mesh& mesh, double x, double half, bool is_void) {
  const test_support::CubeGrid grid = test_support::cube_grid(3);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
  for (const auto& place : grid.places) {
    mesh.positions.push_back(static_cast<float>(x + half * place[0]));
    mesh.positions.push_back(static_cast<float>(half * place[1]));
    mesh.positions.push_back(static_cast<float>(half * place[2]));
    mesh.normals.insert(mesh.normals.end(), {1, 0, 0});
  }
  for (std::size_t t = 0; t < grid.triangles.size(); t += 3) {
    mesh.triangles.push_back(first + grid.triangles[t]);
    mesh.triangles.push_back(first + grid.triangles[t + (is_void ? 2 : 1)]);
    mesh.triangles.push_back(first + grid.triangles[t + (is_void ? 1 : 2)]);
  }
}

// Makes a large body with a void, in which a body with a void of its own floats, and a smaller body with a void beside
// it.
Mesh nested() {
  Mesh mesh;
  add_cube(mesh, 20, 3, false);
  add_cube(mesh, 0, 4, true);
  add_cube(mesh, 0, 2, false);
  add_cube(mesh, 20, 1, true);
  add_cube(mesh, 0, 6, false);
  add_cube(mesh, 0, 1, true);
  return mesh;
}

double cube(double half) {
  return 8 * half * half * half;
}

void expect_kept(const ShellFilter& filter, std::uint64_t bodies, std::uint64_t voids, double volume) {
  const Mesh mesh = nested();
  const KeptShells kept = keep_shells(mesh, filter, 0.1);
  EXPECT_EQ(kept.shells.bodies, bodies);
  EXPECT_EQ(kept.shells.voids, voids);
  EXPECT_EQ(kept.dropped.bodies, 3 - bodies);
  EXPECT_EQ(kept.dropped.voids, 3 - voids);
  const auto report = test_support::check_mesh(kept.mesh.positions, kept.mesh.triangles);
  EXPECT_TRUE(report.sound()) << report.text();
  EXPECT_EQ(report.components, bodies + voids);
  EXPECT_EQ(report.unused_vertices, 0u);
  EXPECT_NEAR(report.volume, volume, 1e-3);
  EXPECT_EQ(kept.mesh.normals.size(), kept.mesh.positions.size());
}

TEST(MeshShells, TheLargestBodyKeepsItsOwnVoidsAlone) {
  expect_kept({.largest_body = true}, 1, 1, cube(6) - cube(4));
}

TEST(MeshShells, FilledVoidsTakeWhatFloatsInThemAlong) {
  expect_kept({.fill_voids = true}, 2, 0, cube(6) + cube(3));
}

TEST(MeshShells, OfTheLargestBodyVoidsAreFilled) {
  expect_kept({.largest_body = true, .fill_voids = true}, 1, 0, cube(6));
}

TEST(MeshShells, WithoutAFilterAllStays) {
  const Mesh mesh = nested();
  const KeptShells kept = keep_shells(mesh, {}, 0.1);
  EXPECT_EQ(kept.mesh.positions, mesh.positions);
  EXPECT_EQ(kept.mesh.triangles, mesh.triangles);
  EXPECT_TRUE(keep_shells({}, {.largest_body = true}, 0.1).mesh.triangles.empty());
}

// Returns the cells of a mesh whose vertices all lie in one brick.
std::shared_ptr<const MeshCells> cells_of(const Mesh& mesh, std::uint32_t x) {
  auto cells = std::make_shared<MeshCells>();
  cells->positions = mesh.positions;
  cells->corners = mesh.triangles;
  cells->bricks = {{x, 0, 0, static_cast<std::uint32_t>(mesh.positions.size() / 3),
                    static_cast<std::uint32_t>(mesh.triangles.size() / 3)}};
  return cells;
}

TEST(MeshShells, OfLessThanHalfACellsMeanThicknessAreSlivers) {
  Mesh mesh = nested();
  const auto at = static_cast<std::ptrdiff_t>(mesh.positions.size());
  add_cube(mesh, 40, 1, false);
  for (auto z = at + 2; z < static_cast<std::ptrdiff_t>(mesh.positions.size()); z += 3) mesh.positions[z] *= 0.01f;
  // The slab measures 2 by 2 by 0.02. The mean thickness of a cube is a third of its edge: 2/3 for the smallest cube.
  const auto slivers = [&](double cell) {
    const ShellCounts counts = count_shells({cells_of(mesh, 0)}, cell);
    return std::vector<std::uint64_t>{counts.sliver_bodies, counts.sliver_voids};
  };
  EXPECT_EQ(slivers(0.03), (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(slivers(0.05), (std::vector<std::uint64_t>{1, 0}));
  EXPECT_EQ(slivers(1.3), (std::vector<std::uint64_t>{1, 0}));
  EXPECT_EQ(slivers(1.4), (std::vector<std::uint64_t>{1, 2}));
  const ShellCounts counts = count_shells({cells_of(mesh, 0)}, 0.05);
  EXPECT_NEAR(counts.sliver[0], 40, 1.01);
  const KeptShells kept = keep_shells(mesh, {.fill_voids = true}, 0.05);
  EXPECT_EQ(kept.shells.bodies, 3u);
  EXPECT_EQ(kept.shells.sliver_bodies, 1u);
}

TEST(MeshShells, AreCountedOverParts) {
  EXPECT_EQ(count_shells({}, 0.1).bodies, 0u);
  Mesh one;
  add_cube(one, 1e6, 3, false);
  EXPECT_EQ(count_shells({cells_of(one, 0)}, 0.1).bodies, 1u);
  EXPECT_EQ(count_shells({cells_of(one, 0)}, 0.1).voids, 0u);
  const ShellCounts all = count_shells({cells_of(nested(), 0), cells_of(one, 1)}, 0.1);
  EXPECT_EQ(all.bodies, 4u);
  EXPECT_EQ(all.voids, 3u);
}

}  // namespace
}  // namespace isofield::engine
