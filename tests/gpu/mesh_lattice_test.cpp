// Tests meshes of surfaces that run through points of the lattice: along its planes, its edges, and into its corners.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "blobtree/geometry/affine.h"
#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/mesh_check.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::Affine;
using blobtree::dvec3;
using engine::Mesh;
using engine::MeshRequest;
using test_support::MeshReport;

Mesh mesh_of(const v1::Scene& scene, const MeshRequest& request) {
  static engine::Mesher mesher(device(), kernels(), workers());
  absl::StatusOr<Mesh> mesh = mesher.mesh(*resident(scene), request, {});
  EXPECT_TRUE(mesh.ok()) << mesh.status();
  return mesh.ok() ? *std::move(mesh) : Mesh{};
}

// One of the 24 rotations of a cube, as two turns by multiples of 90 degrees. A scene states them one after the other.
struct Turn {
  int about_z = 0;      // in quarters; this turn comes first
  dvec3 then{1, 0, 0};  // an axis, and the quarters about it
  int quarters = 0;

  Affine map() const {
    constexpr double kQuarter = std::numbers::pi / 2;
    return Affine::rotation(then, quarters * kQuarter).after(Affine::rotation({0, 0, 1}, about_z * kQuarter));
  }
  // Returns nodes that turn the node `child`.
  std::string nodes_above(const std::string& child) const {
    return absl::StrCat(R"(, {"name": "first turn", "transform": {"child": ")", child, R"(", "rotation": [0, 0, 1, )",
                        90 * about_z, R"(]}}, {"name": "turned", "transform": {"child": "first turn", "rotation": [)",
                        then.x, ", ", then.y, ", ", then.z, ", ", 90 * quarters, "]}}");
  }
};

std::vector<Turn> turns() {
  std::vector<Turn> all;
  for (int about_z = 0; about_z < 4; ++about_z) {
    for (int quarters = 0; quarters < 4; ++quarters) all.push_back({about_z, {1, 0, 0}, quarters});
    for (const int quarters : {1, 3}) all.push_back({about_z, {0, 1, 0}, quarters});
  }
  return all;
}

// Returns the largest distance of one of these points from its nearest vertex.
double furthest_corner(const Mesh& mesh, const std::vector<dvec3>& corners) {
  double furthest = 0;
  for (const dvec3& c : corners) {
    double nearest = INFINITY;
    for (std::size_t v = 0; v < mesh.positions.size(); v += 3) {
      nearest = std::min(nearest, length(dvec3{mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]} - c));
    }
    furthest = std::max(furthest, nearest);
  }
  return furthest;
}

std::vector<dvec3> box_corners(const dvec3& centre, const dvec3& half, const Affine& map) {
  std::vector<dvec3> corners;
  for (int c = 0; c < 8; ++c) {
    corners.push_back(
        map.point(centre + dvec3{c & 1 ? half.x : -half.x, c & 2 ? half.y : -half.y, c & 4 ? half.z : -half.z}));
  }
  return corners;
}

std::string law_of(bool is_signed) {
  return is_signed ? R"("law": "SIGNED")" : R"("range": 0.5)";
}
double iso_of(bool is_signed) {
  return is_signed ? 0 : 0.5;
}

struct Solid {
  std::size_t bodies;
  std::int64_t genus;
  double volume;
  double more = 0;  // a blend may add this much
};

void expect_solid(const Mesh& mesh, const Solid& solid, double cell, const std::string& what) {
  const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
  EXPECT_TRUE(report.sound()) << what << ": " << report.text();
  EXPECT_EQ(report.components, solid.bodies) << what << ": " << report.text();
  EXPECT_EQ(report.genus(), solid.genus) << what << ": " << report.text();
  EXPECT_GE(report.volume, solid.volume * (1 - 0.02 * cell)) << what << ": " << report.text();
  EXPECT_LE(report.volume, solid.volume * (1 + 0.02 * cell) + solid.more) << what << ": " << report.text();
}

// The first cells divide every length of the solids below; the second ones divide none.
constexpr std::array<double, 4> kDividing{0.1, 0.05, 0.25, 0.125};
constexpr std::array<double, 2> kOther{0.0871, 0.13};

TEST(MeshLattice, TurnedBoxesHaveAllTheirCorners) {
  for (const bool is_signed : {true, false}) {
    double worst = 0;
    for (const dvec3& centre : {dvec3{0, 0, 0}, dvec3{3.5, -12, 40}}) {
      const std::string box = absl::StrCat(R"([{"name": "box", "box": {"center": [)", centre.x, ", ", centre.y, ", ",
                                           centre.z, R"(], "half_size": [1, 0.5, 0.5], )", law_of(is_signed), "}}");
      for (const Turn& turn : turns()) {
        const v1::Scene scene = test_support::scene_of_nodes(box + turn.nodes_above("box") + "]");
        for (const double cell : kDividing) {
          const Mesh mesh = mesh_of(scene, {.cell_size = cell, .iso = iso_of(is_signed)});
          const std::string what = absl::StrCat(scene.ShortDebugString(), ", cell ", cell);
          expect_solid(mesh, {1, 0, 2}, cell, what);
          const double furthest = furthest_corner(mesh, box_corners(centre, {1, 0.5, 0.5}, turn.map())) / cell;
          worst = std::max(worst, furthest);
          EXPECT_LE(furthest, 0.02) << what;
        }
      }
    }
    std::cout << "the furthest corner is " << worst << " cells off\n";
  }
}

TEST(MeshLattice, ShearedBoxesHaveAllTheirCorners) {
  double worst = 0;
  int meshes = 0;
  for (const double shear : {0.5, -0.5}) {
    const Affine map{{{{1, 0, shear}, {0, 1, 0}, {0, 0, 1}}}, {}};
    const std::string box = absl::StrCat(R"([{"name": "box", "box": {"half_size": [1, 0.5, 0.5], "law": "SIGNED"}},
                         {"name": "sheared", "transform": {"child": "box", "matrix": [1, 0, )",
                                         shear, R"(, 0, 0, 1, 0, 0, 0, 0, 1, 0]}})");
    for (const Turn& turn : turns()) {
      const v1::Scene scene = test_support::scene_of_nodes(box + turn.nodes_above("sheared") + "]");
      for (const double cell : kDividing) {
        if (std::abs(std::remainder(0.5 * shear, cell)) > 1e-9) continue;
        ++meshes;
        const Mesh mesh = mesh_of(scene, {.cell_size = cell, .iso = 0});
        const std::string what = absl::StrCat(scene.ShortDebugString(), ", cell ", cell);
        expect_solid(mesh, {1, 0, 2}, cell, what);
        const double furthest = furthest_corner(mesh, box_corners({}, {1, 0.5, 0.5}, turn.map().after(map))) / cell;
        worst = std::max(worst, furthest);
        EXPECT_LE(furthest, 0.02) << what;
      }
    }
  }
  EXPECT_EQ(meshes, 2 * 24 * 3) << "cells of 0.1 do not divide the shear";
  std::cout << "the furthest corner is " << worst << " cells off\n";
}

// Counts the sides of a box, given in its own frame, that cross edges of the lattice cell around a corner of the box.
std::size_t sides_seen(const dvec3& corner, const dvec3& half, const Affine& map, double cell) {
  const Affine inverse = *map.inverse();
  const auto depths = [&](const dvec3& p) {
    const dvec3 q = inverse.point(p);
    return std::array<double, 3>{half.x - std::abs(q.x), half.y - std::abs(q.y), half.z - std::abs(q.z)};
  };
  const auto depth = [&](const dvec3& p) {
    const auto d = depths(p);
    return std::min({d[0], d[1], d[2]});
  };
  const auto below = [&](double x) { return std::floor(x / cell); };
  const auto point = [&](double i, double j, double k) { return dvec3{i * cell, j * cell, k * cell}; };
  const double i = below(corner.x), j = below(corner.y), k = below(corner.z);
  std::array<bool, 3> sees{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int at = 0; at < 4; ++at) {
      const int u = at & 1, v = at >> 1;
      const std::array<int, 3> low = axis == 0   ? std::array<int, 3>{0, u, v}
                                     : axis == 1 ? std::array<int, 3>{u, 0, v}
                                                 : std::array<int, 3>{u, v, 0};
      dvec3 a = point(i + low[0], j + low[1], k + low[2]);
      dvec3 b = point(i + low[0] + (axis == 0), j + low[1] + (axis == 1), k + low[2] + (axis == 2));
      if ((depth(a) > 0) == (depth(b) > 0)) continue;
      if (depth(a) < 0) std::swap(a, b);
      for (int step = 0; step < 40; ++step) {
        const dvec3 middle = (a + b) * 0.5;
        (depth(middle) > 0 ? a : b) = middle;
      }
      const auto d = depths(a);
      sees[std::min_element(d.begin(), d.end()) - d.begin()] = true;
    }
  }
  return sees[0] + sees[1] + sees[2];
}

TEST(MeshLattice, BoxesTurnedAnyWayHaveMostOfTheirCorners) {
  test_support::Random random(5);
  const dvec3 half{1, 0.5, 0.5};
  constexpr double kCell = 0.08;
  std::array<std::vector<double>, 4> cuts;  // by the number of sides that the corner's cell sees
  for (int n = 0; n < 100; ++n) {
    const dvec3 axis{random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
    const double degrees = random.number(0, 180);
    const dvec3 centre{random.number(-0.1, 0.1), random.number(-0.1, 0.1), random.number(-0.1, 0.1)};
    const v1::Scene scene = test_support::scene_of_nodes(absl::StrCat(
        R"([{"name": "box", "box": {"half_size": [1, 0.5, 0.5], "law": "SIGNED"}},
            {"transform": {"child": "box", "rotation": [)",
        axis.x, ", ", axis.y, ", ", axis.z, ", ", degrees, R"(], "translation": [)", centre.x, ", ", centre.y, ", ",
        centre.z, "]}}]"));
    const Affine map = Affine::translation(centre).after(Affine::rotation(axis, degrees * std::numbers::pi / 180));
    const Mesh mesh = mesh_of(scene, {.cell_size = kCell, .iso = 0});
    const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
    EXPECT_TRUE(report.sound()) << report.text();
    for (const dvec3& corner : box_corners({}, half, map)) {
      cuts[sides_seen(corner, half, map, kCell)].push_back(furthest_corner(mesh, {corner}) / kCell);
    }
  }
  std::ptrdiff_t kept = 0;
  for (std::size_t sides = 0; sides < cuts.size(); ++sides) {
    std::vector<double>& c = cuts[sides];
    kept += std::count_if(c.begin(), c.end(), [](double x) { return x <= 0.02; });
    if (c.empty()) continue;
    std::sort(c.begin(), c.end());
    std::cout << c.size() << " corners in cells that see " << sides
              << " sides: " << std::count_if(c.begin(), c.end(), [](double x) { return x <= 0.02; })
              << " within 0.02 cells, mean " << std::accumulate(c.begin(), c.end(), 0.0) / c.size() << ", 95 % within "
              << c[c.size() * 95 / 100] << ", the furthest " << c.back() << "\n";
  }
  EXPECT_GE(kept, 580) << "of 800 corners";
  ASSERT_GE(cuts[3].size(), 400u);
  ASSERT_GE(cuts[2].size(), 150u);
  ASSERT_FALSE(cuts[0].empty());
  // The other corners lie in cells with several patches, or their creases end in the cells beside them. If the surface
  // crosses no edge of a corner's cell, the corner is cut off, because the vertices beside it keep to their own cells.
  EXPECT_LE(cuts[3][cuts[3].size() * 99 / 100], 0.02);
  EXPECT_LE(cuts[2][cuts[2].size() * 9 / 10], 0.02);
  EXPECT_LE(cuts[0].back(), 1);
}

// Makes two boxes joined by the operation, turns them in every way, and meshes them with every cell size.
void expect_of_pairs(const std::string& a, const std::string& b, const std::string& operation, bool is_signed,
                     const Solid& solid, bool counts_bodies = true) {
  const std::string pair = absl::StrCat(R"([{"name": "a", "box": {)", a, ", ", law_of(is_signed), R"(}},
      {"name": "b", "box": {)",
                                        b, ", ", law_of(is_signed), R"(}},
      {"name": "pair", ")",
                                        operation, R"(": {"children": ["a", "b"]}})");
  for (const Turn& turn : turns()) {
    const v1::Scene scene = test_support::scene_of_nodes(pair + turn.nodes_above("pair") + "]");
    std::vector<double> cells(kDividing.begin(), kDividing.end());
    cells.insert(cells.end(), kOther.begin(), kOther.end());
    for (const double cell : cells) {
      const Mesh mesh = mesh_of(scene, {.cell_size = cell, .iso = iso_of(is_signed)});
      const std::string what = absl::StrCat(scene.ShortDebugString(), ", cell ", cell);
      if (counts_bodies) {
        expect_solid(mesh, solid, cell, what);
      } else {
        const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
        EXPECT_TRUE(report.sound()) << what << ": " << report.text();
        EXPECT_NEAR(report.volume, solid.volume, 0.15 * cell * solid.volume) << what << ": " << report.text();
      }
    }
  }
}

TEST(MeshLattice, BoxesThatShareAFaceAreOneBody) {
  const std::string a = R"("center": [0.5, 0, 0], "half_size": [0.5, 0.5, 0.5])",
                    b = R"("center": [-0.5, 0, 0], "half_size": [0.5, 0.5, 0.5])";
  expect_of_pairs(a, b, "max", false, {1, 0, 2});
  expect_of_pairs(a, b, "min", true, {1, 0, 2});
  expect_of_pairs(a, b, "gradient", false, {1, 0, 2, 0.04});
}

TEST(MeshLattice, FlushDifferencesAreOpen) {
  const std::string cube = R"("half_size": [1, 1, 1])";
  for (const bool is_signed : {false, true}) {
    expect_of_pairs(cube, R"("center": [0, 0, 0.5], "half_size": [0.5, 0.5, 0.5])", "difference", is_signed, {1, 0, 7});
    expect_of_pairs(cube, R"("half_size": [0.5, 0.5, 1])", "difference", is_signed, {1, 1, 6});
  }
}

TEST(MeshLattice, ContactsAlongEdgesAndAtCornersStayManifold) {
  const std::string a = R"("center": [0.5, 0.5, 0.5], "half_size": [0.5, 0.5, 0.5])";
  for (const bool is_signed : {false, true}) {
    const char* unite = is_signed ? "min" : "max";
    for (const char* centre :
         {"-0.5, -0.5, 0.5", "-0.5, 0.5, -0.5", "-0.5, -0.5, -0.5", "-0.5, 0, 0.5", "1.5, -0.5, 1.5"}) {
      const bool shares_face = std::string(centre) == "-0.5, 0, 0.5";
      expect_of_pairs(a, absl::StrCat(R"("center": [)", centre, R"(], "half_size": [0.5, 0.5, 0.5])"), unite, is_signed,
                      {1, 0, 2}, shares_face);
    }
  }
}

TEST(MeshLattice, RoundSurfacesMayTouchItsPlanes) {
  const struct {
    const char* nodes;
    Solid solid;
  } cases[] = {
      {R"([{"sphere": {"radius": 1, "range": 0.5}}])", {1, 0, 4 * std::numbers::pi / 3}},
      {R"([{"sphere": {"radius": 1, "law": "SIGNED"}}])", {1, 0, 4 * std::numbers::pi / 3}},
      {R"([{"cylinder": {"a": [0, 0, -1], "b": [0, 0, 1], "radius": 1, "range": 0.5}}])", {1, 0, 2 * std::numbers::pi}},
      {R"([{"name": "a", "sphere": {"center": [1, 0, 0], "radius": 1, "range": 0.5}},
           {"name": "b", "sphere": {"center": [-1, 0, 0], "radius": 1, "range": 0.5}},
           {"max": {"children": ["a", "b"]}}])",
       {2, 0, 8 * std::numbers::pi / 3}}};
  for (const auto& c : cases) {
    const v1::Scene scene = test_support::scene_of_nodes(c.nodes);
    const double iso = std::string(c.nodes).find("SIGNED") == std::string::npos ? 0.5 : 0;
    for (const double cell : {0.1, 0.05}) {
      const Mesh mesh = mesh_of(scene, {.cell_size = cell, .iso = iso});
      const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
      EXPECT_TRUE(report.sound()) << c.nodes << ": " << report.text();
      EXPECT_EQ(report.genus(), 0) << c.nodes << ": " << report.text();
      EXPECT_NEAR(report.volume, c.solid.volume, 0.2 * cell * c.solid.volume) << c.nodes << ": " << report.text();
    }
  }
}

TEST(MeshLattice, OtherLevelsAndStatedBoundsMayFallOnIt) {
  // `out` is the distance at which the field of a range of 0.5 is 0.3: w(R0 + (1 - R0) d / 0.5) = 0.3, w(r) = (1 -
  // r^2)^3.
  const double r0 = std::sqrt(1 - std::cbrt(0.5)), r = std::sqrt(1 - std::cbrt(0.3)), out = 0.5 * (r - r0) / (1 - r0);
  const v1::Scene cube = test_support::scene_of_nodes(R"([{"name": "a", "box": {"half_size": [1, 1, 1], "range": 0.5}},
       {"name": "t", "transform": {"child": "a", "rotation": [1, 0, 0, 90]}}])");
  // The level set is rounded beside the cube's edges.
  const double half = 1 + out, cell = half / 16;
  const blobtree::Box beyond{{-half - 3 * cell, -half - 3 * cell, -half - 3 * cell},
                             {half + 3 * cell, half + 3 * cell, half + 3 * cell}};
  const MeshReport level = [&] {
    const Mesh mesh = mesh_of(cube, {.cell_size = cell, .bounds = beyond, .iso = 0.3});
    return test_support::check_mesh(mesh.positions, mesh.triangles);
  }();
  EXPECT_TRUE(level.sound()) << level.text();
  EXPECT_EQ(level.components, 1u);
  EXPECT_EQ(level.genus(), 0);
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(level.volume, 8 + 24 * out + 6 * kPi * out * out + 4 * kPi / 3 * std::pow(out, 3), 0.02);
  // These bounds lie on the cube's own faces.
  for (const double size : {0.1, 0.25, 0.07}) {
    const Mesh mesh = mesh_of(cube, {.cell_size = size, .bounds = blobtree::Box{{-1, -1, -1}, {1, 1, 1}}});
    const MeshReport report = test_support::check_mesh(mesh.positions, mesh.triangles);
    EXPECT_TRUE(report.sound()) << report.text();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.genus(), 0);
    EXPECT_GE(report.volume, std::pow(2 - 2 * size, 3));
    EXPECT_LE(report.volume, 8.001);
  }
}

TEST(MeshLattice, PartsOfWhatRunsThroughItAreTheWhole) {
  const v1::Scene scene = test_support::scene_of_nodes(R"([
      {"name": "a", "box": {"center": [1, 0, 0], "half_size": [1, 1, 1], "range": 0.5}},
      {"name": "b", "box": {"center": [-1, 0, 0], "half_size": [1, 1, 1], "range": 0.5}},
      {"name": "u", "max": {"children": ["a", "b"]}},
      {"name": "t", "transform": {"child": "u", "rotation": [0, 0, 1, 90]}}])");
  MeshRequest request{.cell_size = 0.05};
  const Mesh whole = mesh_of(scene, request);
  ASSERT_FALSE(whole.triangles.empty());
  for (const std::size_t at_once : {40, 700}) {
    request.bricks_at_once = at_once;
    const Mesh joined = mesh_of(scene, request);
    EXPECT_EQ(whole.positions, joined.positions);
    EXPECT_EQ(whole.normals, joined.normals);
    EXPECT_EQ(whole.triangles, joined.triangles);
  }
}

}  // namespace
}  // namespace isofield::gpu_test
