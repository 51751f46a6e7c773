// Compares the creases of meshes with the surfaces that meet there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <numbers>
#include <vector>

#include "engine/mesh/mesher.h"
#include "engine/simplify/mesh_simplifier.h"
#include "gpu/gpu_environment.h"
#include "support/mesh_check.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using engine::Mesh;

// A side of a crease, as a distance function. Its gradient has length 1, and it is positive only outside of the solid.
using Side = std::function<double(const dvec3&)>;

dvec3 normal_of(const Side& side, const dvec3& p) {
  constexpr double h = 1e-5;
  return dvec3{side({p.x + h, p.y, p.z}) - side({p.x - h, p.y, p.z}),
               side({p.x, p.y + h, p.z}) - side({p.x, p.y - h, p.z}),
               side({p.x, p.y, p.z + h}) - side({p.x, p.y, p.z - h})} *
         (0.5 / h);
}

// Returns the point where both sides are 0, by Newton's method along the shortest way from p.
dvec3 onto_crease(const Side& a, const Side& b, const dvec3& p) {
  dvec3 x = p;
  for (int step = 0; step < 8; ++step) {
    const dvec3 n = normal_of(a, x), m = normal_of(b, x);
    const double c = dot(n, m), fa = a(x), fb = b(x), scale = 1 / (1 - c * c);
    x = x - n * (scale * (fa - c * fb)) - m * (scale * (fb - c * fa));
  }
  return x;
}

dvec3 onto_side(const Side& side, dvec3 p) {
  for (int step = 0; step < 3; ++step) p = p - normal_of(side, p) * side(p);
  return p;
}

double degrees_between(const dvec3& a, const dvec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

struct Face {
  std::array<std::uint32_t, 3> vertices;
  std::array<dvec3, 3> corners;
  dvec3 normal;
  std::size_t side;
};

dvec3 normal_of(const std::array<dvec3, 3>& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

// Checks that every edge between triangles of different sides has both ends on their crease within 0.5 % of a cell, and
// that the edges make up the whole crease.
//
// The angle of the two triangles at such an edge is compared with an exact one, within a degree: the triangles' angle
// if their corners were exactly on the sides, the edge's ends on both and the third corners on one each. Between flat
// sides that is the sides' angle. A triangle inscribed in a curved side leans by up to about its circumradius over the
// side's radius of curvature. It leans most where the third corner lies past the edge's end, as beside cells of which
// the crease cuts off a corner. The triangle leans more than the side does over it because of the cells, and this
// excess falls with their size: it is at most 4 degrees at 64 cells.
void expect_creases(const v1::Scene& scene, double cell, const std::vector<Side>& sides, double crease_length,
                    double iso = 0.5, double simplification_error = 0) {
  static engine::Mesher mesher(device(), kernels(), workers());
  absl::StatusOr<Mesh> mesh = mesher.mesh(*resident(scene), {.cell_size = cell, .iso = iso}, {});
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  if (simplification_error > 0) {
    const std::size_t before = mesh->triangles.size() / 3;
    mesh = engine::simplify(*mesh, simplification_error, {});
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    std::cout << before << " triangles, simplified " << mesh->triangles.size() / 3 << "\n";
    EXPECT_LT(mesh->triangles.size() / 3, before / 4);
  }
  const test_support::MeshReport report = test_support::check_mesh(mesh->positions, mesh->triangles);
  ASSERT_TRUE(report.sound()) << report.text();
  EXPECT_EQ(report.zero_area, 0u);

  const auto position = [&](std::uint32_t v) {
    const float* p = &mesh->positions[3 * std::size_t{v}];
    return dvec3{p[0], p[1], p[2]};
  };
  std::vector<Face> faces;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> edges;
  std::size_t flipped = 0;
  for (std::size_t t = 0; t < mesh->triangles.size(); t += 3) {
    const std::array<std::uint32_t, 3> v{mesh->triangles[t], mesh->triangles[t + 1], mesh->triangles[t + 2]};
    const dvec3 a = position(v[0]), b = position(v[1]), c = position(v[2]);
    Face face{v, {a, b, c}, normal_of({a, b, c}), 0};
    const dvec3 middle = (a + b + c) * (1.0 / 3);
    // The ends of a crease lie on both of its sides, so the normal decides.
    const auto off = [&](const Side& s) {
      return (std::abs(s(a)) + std::abs(s(b)) + std::abs(s(c))) / cell +
             0.01 * degrees_between(face.normal, normal_of(s, middle));
    };
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (off(sides[i]) < off(sides[face.side])) face.side = i;
    }
    flipped += dot(face.normal, normal_of(sides[face.side], middle)) <= 0;
    for (int i = 0; i < 3; ++i) edges[std::minmax(v[i], v[(i + 1) % 3])].push_back(faces.size());
    faces.push_back(face);
  }
  EXPECT_EQ(flipped, 0u);

  double worst = 0, worst_angle = 0, worst_lean = 0, total = 0;
  std::size_t count = 0, off = 0, bent = 0, leaning = 0;
  for (const auto& [ends, around] : edges) {
    const Face &f = faces[around[0]], &g = faces[around[1]];
    if (f.side == g.side) continue;
    const Side &a = sides[f.side], &b = sides[g.side];
    ++count;
    total += length(position(ends.first) - position(ends.second));
    for (const std::uint32_t v : {ends.first, ends.second}) {
      const double distance = length(onto_crease(a, b, position(v)) - position(v)) / cell;
      worst = std::max(worst, distance);
      off += distance > 0.005;
    }
    const auto inscribed = [&, &ends = ends](const Face& face, const Side& side) {
      std::array<dvec3, 3> corners = face.corners;
      for (int i = 0; i < 3; ++i) {
        const bool is_end = face.vertices[i] == ends.first || face.vertices[i] == ends.second;
        corners[i] = is_end ? onto_crease(a, b, corners[i]) : onto_side(side, corners[i]);
      }
      return normal_of(corners);
    };
    const double exact = degrees_between(inscribed(f, a), inscribed(g, b));
    const double error = std::abs(degrees_between(f.normal, g.normal) - exact);
    worst_angle = std::max(worst_angle, error);
    bent += error > 1;

    double least = 180, most = 0;
    for (const dvec3& p : f.corners) {
      for (const dvec3& q : g.corners) {
        const double sides_meet = degrees_between(normal_of(a, p), normal_of(b, q));
        least = std::min(least, sides_meet);
        most = std::max(most, sides_meet);
      }
    }
    const double lean = std::max({least - exact, exact - most, 0.0});
    worst_lean = std::max(worst_lean, lean);
    leaning += lean > 1;
  }
  std::cout << count << " edges on creases, furthest end " << worst << " cells off; worst angle " << worst_angle
            << " degrees off; " << leaning << " lean by more than a degree, at most " << worst_lean << "; length "
            << total << " of " << crease_length << "\n";
  EXPECT_EQ(off, 0u);
  EXPECT_EQ(bent, 0u);
  EXPECT_LE(worst_lean, 4);
  EXPECT_NEAR(total, crease_length, 0.01 * crease_length);
}

Side plane(const dvec3& n, double distance) {
  const double inverse = 1 / length(n);
  return [=](const dvec3& p) { return dot(n, p) * inverse - distance; };
}
Side ball(const dvec3& centre, double radius, double sign = 1) {
  return [=](const dvec3& p) { return sign * (length(p - centre) - radius); };
}
std::vector<Side> box_sides(const dvec3& centre, double half) {
  std::vector<Side> sides;
  for (const dvec3& n : {dvec3{1, 0, 0}, dvec3{0, 1, 0}, dvec3{0, 0, 1}}) {
    sides.push_back(plane(n, dot(n, centre) + half));
    sides.push_back(plane(n * -1.0, half - dot(n, centre)));
  }
  return sides;
}
constexpr double kPi = std::numbers::pi;
constexpr double kCell = 2.0 / 64;

TEST(MeshCreases, OfACube) {
  // The cube lies in general position, and then on the lattice.
  for (const dvec3& c : {dvec3{0.011, 0.007, -0.013}, dvec3{0, 0, 0}}) {
    v1::Scene scene = test_support::scene_of_nodes(R"([{"box": {"half_size": [1, 1, 1], "range": 0.5}}])");
    for (const double x : {c.x, c.y, c.z}) scene.mutable_nodes(0)->mutable_box()->add_center(x);
    expect_creases(scene, kCell, box_sides(c, 1), 24);
  }
}

TEST(MeshCreases, OfASignedCube) {
  expect_creases(test_support::scene_of_nodes(
                     R"([{"box": {"center": [0.011, 0.007, -0.013], "half_size": [1, 1, 1], "law": "SIGNED"}}])"),
                 kCell, box_sides({0.011, 0.007, -0.013}, 1), 24, 0);
}

TEST(MeshCreases, OfACubeLessASphere) {
  std::vector<Side> sides = box_sides({0.011, 0.007, -0.013}, 1);
  sides.push_back(ball({0.03, -0.02, 1.3}, 0.9, -1));
  const double height = 1.3 - 0.987, rim = std::sqrt(0.81 - height * height);
  for (const char* law : {R"("range": 0.5)", R"("law": "SIGNED")"}) {
    const std::string text = std::string(R"([
      {"name": "a", "box": {"center": [0.011, 0.007, -0.013], "half_size": [1, 1, 1], )") +
                             law + R"(}},
      {"name": "b", "sphere": {"center": [0.03, -0.02, 1.3], "radius": 0.9, )" +
                             law + R"(}},
      {"difference": {"children": ["a", "b"]}}])";
    expect_creases(test_support::scene_of_nodes(text), kCell, sides, 24 + 2 * kPi * rim,
                   text.find("SIGNED") == std::string::npos ? 0.5 : 0);
  }
}

TEST(MeshCreases, StaySharpWhenSimplified) {
  std::vector<Side> sides = box_sides({0.011, 0.007, -0.013}, 1);
  sides.push_back(ball({0.03, -0.02, 1.3}, 0.9, -1));
  const double height = 1.3 - 0.987, rim = std::sqrt(0.81 - height * height);
  const v1::Scene scene = test_support::scene_of_nodes(R"([
      {"name": "a", "box": {"center": [0.011, 0.007, -0.013], "half_size": [1, 1, 1], "range": 0.5}},
      {"name": "b", "sphere": {"center": [0.03, -0.02, 1.3], "radius": 0.9, "range": 0.5}},
      {"difference": {"children": ["a", "b"]}}])");
  expect_creases(scene, kCell, sides, 24 + 2 * kPi * rim, 0.5, 0.01 * kCell);
}

TEST(MeshCreases, OfACleanUnionOfCylinders) {
  const char* const cylinders = R"([
    {"name": "a", "cylinder": {"a": [-1, 0.01, 0.02], "b": [1, 0.01, 0.02], "radius": 0.5, "range": 0.4}},
    {"name": "b", "cylinder": {"a": [0.03, 0.01, -1], "b": [0.03, 0.01, 1], "radius": 0.35, "range": 0.4}},
    {"OPERATOR": {"children": ["a", "b"]}}])";
  const std::vector<Side> sides{[](const dvec3& p) { return std::hypot(p.y - 0.01, p.z - 0.02) - 0.5; },
                                [](const dvec3& p) { return std::hypot(p.x - 0.03, p.y - 0.01) - 0.35; },
                                plane({1, 0, 0}, 1),
                                plane({-1, 0, 0}, 1),
                                plane({0, 0, 1}, 1),
                                plane({0, 0, -1}, 1)};
  // The loop is where the thin cylinder leaves the thick one; t is the angle around the thin one.
  double loop = 0;
  const auto at = [](double t) {
    const double y = 0.35 * std::sin(t);
    return dvec3{0.35 * std::cos(t), y, std::sqrt(0.25 - y * y)};
  };
  for (int i = 0; i < 10'000; ++i) loop += length(at(2 * kPi * (i + 1) / 10'000) - at(2 * kPi * i / 10'000));
  for (const std::string op : {"clean", "max"}) {
    std::string text = cylinders;
    text.replace(text.find("OPERATOR"), 8, op);
    expect_creases(test_support::scene_of_nodes(text), kCell, sides, 2 * loop + 4 * kPi * (0.5 + 0.35));
  }
}

TEST(MeshCreases, OfACubeWithinASphere) {
  std::vector<Side> sides = box_sides({0.011, 0.007, -0.013}, 1);
  sides.push_back(ball({0.011, 0.007, -0.013}, 1.3));
  for (const bool is_signed : {false, true}) {
    const std::string law = is_signed ? R"("law": "SIGNED")" : R"("range": 0.5)";
    const std::string text = R"([
      {"name": "a", "box": {"center": [0.011, 0.007, -0.013], "half_size": [1, 1, 1], )" +
                             law + R"(}},
      {"name": "b", "sphere": {"center": [0.011, 0.007, -0.013], "radius": 1.3, )" +
                             law + R"(}},
      {")" + (is_signed ? "max" : "min") +
                             R"(": {"children": ["a", "b"]}}])";
    expect_creases(test_support::scene_of_nodes(text), kCell, sides, 6 * 2 * kPi * std::sqrt(0.69),
                   is_signed ? 0 : 0.5);
  }
}

}  // namespace
}  // namespace isofield::gpu_test
