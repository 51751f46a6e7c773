// Tests the normals of meshes along seams, where two surfaces meet at less than the angle of a crease.
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "engine/mesh/mesher.h"
#include "gpu/gpu_environment.h"
#include "support/scene_text.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using engine::Mesh;

constexpr double kRadius = 0.1;
constexpr double kDegrees = std::numbers::pi / 180;

dvec3 unit(const dvec3& v) {
  return v * (1 / length(v));
}
double degrees_between(const dvec3& a, const dvec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) / kDegrees;
}

// Two tubes that meet at `joint`; neither lies along an axis of the lattice. `along` and `inwards` span the plane of
// the tubes. The seam lies in the plane across `along`, on the side of `inwards`.
struct Bend {
  dvec3 joint, along, inwards, first, second;  // the tubes leave the joint along the last two

  explicit Bend(double degrees) : joint{0.0123, 0.0071, -0.0054} {
    const double half = degrees / 2 * kDegrees;
    along = unit({0.62, 0.31, -0.45});
    inwards = unit(cross(along, dvec3{0.27, -0.88, 0.39}));
    first = inwards * std::sin(half) - along * std::cos(half);
    second = inwards * std::sin(half) + along * std::cos(half);
  }

  static dvec3 normal_of(const dvec3& p, const dvec3& direction) { return unit(p - direction * dot(p, direction)); }

  v1::Scene scene(const std::string& op, const std::string& law) const {
    const auto tube = [&](const char* name, const dvec3& direction) {
      const dvec3 end = joint + direction * 0.4;
      return absl::StrCat("{\"name\": \"", name, "\", \"segment\": {\"a\": [", joint.x, ",", joint.y, ",", joint.z,
                          "], \"b\": [", end.x, ",", end.y, ",", end.z, "], \"radius_a\": ", kRadius,
                          ", \"radius_b\": ", kRadius, ", ", law, "}},");
    };
    return test_support::scene_of_nodes(absl::StrCat("[", tube("a", first), tube("b", second), "{", op, "}]"));
  }
};

struct Union {
  const char *name, *op, *law;
  double iso;
  double most_spread;  // root mean square distance of the shading's middle from the seam, in cells
};
constexpr const char* kPositive = R"("range": 0.1)";
constexpr const char* kSigned = R"("law": "SIGNED")";
const Union kUnions[] = {
    {"camel", R"("gradient": {"children": ["a", "b"], "opening": {"preset": "CAMEL"}})", kPositive, 0.5, 0.12},
    {"max", R"("max": {"children": ["a", "b"]})", kPositive, 0.5, 0.27},
    {"clean", R"("clean": {"children": ["a", "b"]})", kPositive, 0.5, 0.27},
    {"min", R"("min": {"children": ["a", "b"]})", kSigned, 0, 0.27},
    {"r_union", R"("r_union": {"children": ["a", "b"]})", kSigned, 0, 0.27},
    {"superelliptic", R"("superelliptic": {"children": ["a", "b"], "exponent": 2, "ranges": [0.1], "by_angle": true})",
     kSigned, 0, 0.15},
    {"bt2", R"("bt2": {"children": ["a", "b"], "r1": 0.1, "r2": 0.1, "eliminate_bulge": true})", kSigned, 0, 0.15},
};

// The measurements of one vertex beside the seam.
struct Beside {
  double place;    // distance from the plane of the seam, in cells; negative on the first tube
  double turn;     // angle between the tubes' normals there, in degrees; 0 on the outer side, where the tubes touch
  double share;    // the part of the turn that the vertex's normal has made
  double off_own;  // degrees between the vertex's normal and that of the tube it is on
};

class MeshSeams : public testing::TestWithParam<Union> {
 protected:
  void make(double degrees, double cell) {
    static engine::Mesher mesher(device(), kernels(), workers());
    const Bend bend(degrees);
    const absl::StatusOr<Mesh> mesh = mesher.mesh(*resident(bend.scene(GetParam().op, GetParam().law)),
                                                  {.cell_size = cell, .iso = GetParam().iso}, {});
    ASSERT_TRUE(mesh.ok()) << mesh.status();
    triangles_ = mesh->triangles;
    vertices_.clear();
    for (std::size_t v = 0; v < mesh->positions.size(); v += 3) {
      const auto at = [&](const std::vector<float>& rows) { return dvec3{rows[v], rows[v + 1], rows[v + 2]}; };
      const dvec3 p = at(mesh->positions) - bend.joint, n = at(mesh->normals);
      const dvec3 from = Bend::normal_of(p, bend.first), to = Bend::normal_of(p, bend.second), across = to - from;
      const bool is_first = dot(p, bend.along) < 0;
      // A tube is a ball beyond its end.
      const bool is_on_ball = dot(p, is_first ? bend.first : bend.second) < 0;
      vertices_.push_back({dot(p, bend.along) / cell, dot(p, bend.inwards) > 0 ? degrees_between(from, to) : 0,
                           dot(n - from, across) / std::max(dot(across, across), 1e-12),
                           degrees_between(n, is_on_ball ? unit(p)
                                              : is_first ? from
                                                         : to)});
    }
  }

  std::vector<Beside> vertices_;
  std::vector<std::uint32_t> triangles_;
};

INSTANTIATE_TEST_SUITE_P(Unions, MeshSeams, testing::ValuesIn(kUnions),
                         [](const auto& info) { return std::string(info.param.name); });

// Half of the turn along a seam is made on the seam itself, and not up to a cell beside it by the accident of the
// lattice. The rest comes from vertices within a cell of the seam that see only the ball at the end of the other tube:
// this happens beyond the radius times half the turn. Normals are exact where the tubes touch.
TEST_P(MeshSeams, AreShadedEvenly) {
  for (const double degrees : {10, 14, 20, 24}) {
    for (const double cells_per_radius : {3, 5, 8}) {
      make(degrees, kRadius / cells_per_radius);
      std::size_t crossings = 0, touching = 0;
      double squares = 0, furthest = 0, most_off = 0;
      const auto is_beside = [&](const Beside& v) { return std::abs(v.place) < 2.5 && v.turn > 0.6 * degrees; };
      for (std::size_t c = 0; c < triangles_.size(); ++c) {
        const Beside &v = vertices_[triangles_[c]], &w = vertices_[triangles_[c % 3 == 2 ? c - 2 : c + 1]];
        if (!is_beside(v) || !is_beside(w) || v.share >= 0.5 || w.share < 0.5) continue;
        const double place = std::lerp(v.place, w.place, (0.5 - v.share) / (w.share - v.share));
        ++crossings;
        squares += place * place;
        furthest = std::max(furthest, std::abs(place));
      }
      for (const Beside& v : vertices_) {
        if (v.turn > 0 || std::abs(v.place) > 2.5) continue;
        ++touching;
        most_off = std::max(most_off, v.off_own);
      }
      const double spread = std::sqrt(squares / static_cast<double>(crossings));
      std::cout << degrees << " degrees, " << cells_per_radius << " cells a radius: " << crossings
                << " edges across, half the turn at " << spread << " cells of the seam, at most " << furthest << "; "
                << touching << " vertices where the tubes touch, normals at most " << most_off << " degrees off\n";
      ASSERT_GT(crossings, 2 * cells_per_radius);
      ASSERT_GT(touching, 2 * cells_per_radius);
      EXPECT_LT(spread, GetParam().most_spread);
      EXPECT_LT(furthest, 0.5);
      EXPECT_LT(most_off, 2);
    }
  }
}

// Every normal at a crease is that of one side.
TEST_P(MeshSeams, ThatAreCreasesStaySharp) {
  const std::string name = GetParam().name;
  if (name != "max" && name != "min") GTEST_SKIP() << "which is sharp on the surface alone";
  make(40, kRadius / 5);
  std::size_t sharp = 0;
  double most_off = 0;
  for (const Beside& v : vertices_) {
    if (std::abs(v.place) > 2 || v.turn < 27) continue;
    ++sharp;
    most_off = std::max(most_off, std::min(std::abs(v.share), std::abs(v.share - 1)));
  }
  EXPECT_GT(sharp, 40u);
  EXPECT_LT(most_off, 1e-4);
}

}  // namespace
}  // namespace isofield::gpu_test
