#include "blobtree/primitives/primitive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "blobtree/primitives/leaf.h"
#include "blobtree/scene/scene_reader.h"
#include "isofield/v1/operator.pb.h"
#include "isofield/v1/scene.pb.h"
#include "support/primitive_nodes.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::PrimitiveNode;
using test_support::Random;
using test_support::read_or_die;
using test_support::scene_of_nodes;

std::set<std::string> fields_of(const google::protobuf::Descriptor& message) {
  std::set<std::string> names;
  const auto* kind = message.FindOneofByName("kind");
  for (int i = 0; i < kind->field_count(); ++i) names.insert(kind->field(i)->name());
  return names;
}

// The test notices a field that is added to the contract only, as the compiler does in the readers' switches.
TEST(Tables, HaveARowForEveryFieldOfTheContract) {
  std::set<std::string> nodes{"custom", "transform", "soften", "harden"}, operators;
  for (const PrimitiveTraits& kind : kShapes) nodes.emplace(kind.name);
  for (const operators::Traits& kind : operators::kKinds) operators.emplace(kind.name);
  EXPECT_EQ(fields_of(*v1::Operator::descriptor()), operators);
  for (const std::string& name : operators) {
    if (name != "sampled") nodes.insert(name);  // only the operator catalog has it
  }
  EXPECT_EQ(fields_of(*v1::Node::descriptor()), nodes);
}

TEST(Tables, HaveATestNodeOfEveryPrimitive) {
  std::set<std::string> tested, kinds;
  for (const PrimitiveNode& node : test_support::primitive_nodes()) tested.insert(node.kind);
  for (const PrimitiveTraits& kind : kShapes) kinds.emplace(kind.name);
  EXPECT_EQ(tested, kinds);
}

Leaf leaf_of(const std::string& nodes) {
  return compile_or_die(read_or_die(scene_of_nodes(absl::StrCat("[", nodes, "]")))).leaves.at(0);
}

// The boxes have all sizes and lie around and beyond the primitive.
TEST(Primitives, HoldTheirBoundsAndSupports) {
  for (const PrimitiveNode& primitive : test_support::primitive_nodes()) {
    for (const bool is_signed : {false, true}) {
      for (const char* scale : {"[1]", "[1.4, 0.6, 1]"}) {
        const Leaf leaf =
            leaf_of(primitive.text("p", is_signed) +
                    R"(, {"transform": {"child": "p", "rotation": [1, 2, 3, 50], "scale": )" + scale + "}}");
        Random random(3);
        for (int n = 0; n < 3000; ++n) {
          const dvec3 centre = random.point(-2, 2), half = random.point(0, std::exp(random.number(-6, 0.5)));
          const Box box{centre - half, centre + half};
          const Interval d = distance_bounds(leaf, CentredBox(box)), f = field_bounds(leaf, CentredBox(box));
          for (int i = 0; i < 8; ++i) {
            const dvec3 p = centre + dvec3{half.x * random.number(-1, 1), half.y * random.number(-1, 1),
                                           half.z * random.number(-1, 1)};
            ASSERT_GE(leaf.distance(p), d.lo) << primitive.kind;
            ASSERT_LE(leaf.distance(p), d.hi) << primitive.kind;
            if (leaf.distance(p) < leaf.range) {
              ASSERT_TRUE(leaf.support.touches({p, p})) << primitive.kind;
            }
            if (is_signed) {
              ASSERT_LE(leaf.distance(p) * leaf.per_distance, f.hi) << primitive.kind;
            }
          }
        }
      }
    }
  }
}

TEST(HalfSpace, IsTheSideOfItsPlane) {
  const Leaf leaf = leaf_of(R"({"half_space": {"point": [1, 2, 3], "normal": [0, 0, -2], "range": 0.5}})");
  EXPECT_DOUBLE_EQ(leaf.distance({7, -5, 4}), -1);
  EXPECT_DOUBLE_EQ(leaf.distance({0, 0, 2.75}), 0.25);
  // The support ends only beyond the plane, one range further out.
  EXPECT_NEAR(leaf.support.min.z, 2.5, 1e-5);
  EXPECT_GE(leaf.support.max.z, base::kMaxCoordinate);
  EXPECT_FALSE(leaf.support.is_bounded());
}

TEST(HalfSpace, BoundsWhatItIsIntersectedWith) {
  const std::string nodes = R"({"sphere": {"radius": 1, "range": 0.5}},
      {"half_space": {"normal": [1, 0, 0], "range": 0.25}}, )";
  const Tape cut = compile_or_die(read_or_die(scene_of_nodes("[" + nodes + R"({"min": {"children": ["#0", "#1"]}}])")));
  EXPECT_NEAR(cut.support.max.x, 0.25, 1e-5);
  EXPECT_NEAR(cut.support.min.x, -1.5, 1e-5);
  const Tape both =
      compile_or_die(read_or_die(scene_of_nodes("[" + nodes + R"({"max": {"children": ["#0", "#1"]}}])")));
  EXPECT_FALSE(both.support.is_bounded());
}

// A stated point may lie anywhere in the plane. The device gets the point of the plane that is nearest to the origin.
TEST(HalfSpace, IsAnchoredWhereItsPlaneIsNearest) {
  const Leaf leaf = leaf_of(R"({"half_space": {"point": [1e6, 1e6, -2000000], "normal": [1, 1, 1], "law": "SIGNED"}})");
  EXPECT_LT(length(leaf.domain.anchor), 1e-6);
  EXPECT_NEAR(leaf.distance({1, 1, 1}), std::sqrt(3.0), 1e-9);
  const Interval d = distance_bounds(leaf, CentredBox(Box{dvec3(-1), dvec3(1)}));
  EXPECT_NEAR(d.lo, -std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(d.hi, std::sqrt(3.0), 1e-5);
}

TEST(HalfSpace, BoundsWhatItCutsInEitherOrder) {
  const std::string nodes = R"({"name": "ball", "sphere": {"radius": 1, "law": "SIGNED"}},
      {"name": "half", "half_space": {"normal": [1, 0, 0], "law": "SIGNED"}}, )";
  for (const char* cut : {R"("max": {"children": ["ball", "half"])", R"("max": {"children": ["half", "ball"])",
                          R"("smooth_min": {"radius": 0.2, "form": "INTERSECTION", "children": ["ball", "half"])",
                          R"("smooth_min": {"radius": 0.2, "form": "INTERSECTION", "children": ["half", "ball"])"}) {
    const Box support = compile_or_die(read_or_die(scene_of_nodes("[" + nodes + "{" + cut + "}}]"))).support;
    ASSERT_TRUE(support.is_bounded()) << cut;
    EXPECT_TRUE(support.touches({dvec3(-0.99, 0, 0), dvec3(-0.99, 0, 0)})) << cut;
    EXPECT_LT(support.max.y, 1.5) << cut;
  }
}

// Returns the distance of a point (rho, z) of the half-plane to the outline of a trapezoid, segment by segment. It is
// negative inside.
double distance_to_outline(const shapes::Cone& c, double rho, double z) {
  const double h = c.half_length;
  const double x[] = {0, c.radius_a, c.radius_b, 0}, y[] = {-h, -h, h, h};
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp(((rho - x[i]) * dx + (z - y[i]) * dy) / square, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(rho - x[i] - t * dx, z - y[i] - t * dy));
  }
  const double radius = c.radius_a + (c.radius_b - c.radius_a) * (z + h) / (2 * h);
  return std::abs(z) < h && rho < radius ? -least : least;
}

TEST(Cone, IsAsFarAsItsOutline) {
  Random random(12);
  for (int n = 0; n < 200; ++n) {
    shapes::Cone c;
    c.half_length = random.number(0.05, 1);
    c.radius_a = random.chance(0.2) ? 0 : random.number(0.05, 1);
    c.radius_b = random.chance(0.2) && c.radius_a > 0 ? 0 : random.number(0.05, 1);
    for (int i = 0; i < 500; ++i) {
      const dvec3 q = random.point(-2, 2);
      ASSERT_NEAR(c.distance(q), distance_to_outline(c, std::hypot(q.x, q.y), q.z), 1e-12)
          << c.half_length << " " << c.radius_a << " " << c.radius_b << " at " << q.x << " " << q.y << " " << q.z;
    }
  }
}

TEST(Cone, HasATipWhereOneRadiusIsZero) {
  const Leaf leaf = leaf_of(R"({"cone": {"a": [0, 0, 0], "b": [0, 0, 2], "radius_a": 1, "range": 0.5}})");
  EXPECT_NEAR(leaf.distance({0, 0, 2.5}), 0.5, 1e-12);
  EXPECT_NEAR(leaf.distance({0, 0, -0.25}), 0.25, 1e-12);
  EXPECT_NEAR(leaf.distance({1, 0, 0}), 0, 1e-12);
}

TEST(Cone, IsRefusedWithoutARadiusOrALength) {
  const auto refusal = [](const std::string& body) {
    const auto scene = read_scene(scene_of_nodes(R"([{"name": "c", "cone": {)" + body + R"(, "range": 1}}])"));
    return std::string(scene.status().message());
  };
  EXPECT_NE(refusal(R"("a": [0, 0, 0], "b": [0, 0, 1])").find("radius_a = 0"), std::string::npos);
  EXPECT_NE(refusal(R"("a": [0, 0, 0], "b": [0, 0, 1], "radius_a": -1)").find("radius_a = -1"), std::string::npos);
  EXPECT_NE(refusal(R"("a": [0, 0, 0], "b": [0, 0, 0], "radius_a": 1)").find("differs from a"), std::string::npos);
}

}  // namespace
}  // namespace isofield::blobtree
