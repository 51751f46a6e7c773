#include "blobtree/primitives/primitive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "blobtree/primitives/leaf.h"
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

// A field that is added to the contract alone is noticed here, as it is by the compiler in the readers' switches.
TEST(Tables, HaveARowForEveryFieldOfTheContract) {
  std::set<std::string> nodes{"custom", "transform", "soften", "harden"}, operators;
  for (const PrimitiveTraits& kind : kShapes) nodes.emplace(kind.name);
  for (const operators::Traits& kind : operators::kKinds) operators.emplace(kind.name);
  EXPECT_EQ(fields_of(*v1::Operator::descriptor()), operators);
  for (const std::string& name : operators) {
    if (name != "sampled") nodes.insert(name);  // the catalogue's alone
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

// Boxes of all sizes around and beyond the primitive.
TEST(Primitives, HoldTheirBoundsAndSupports) {
  for (const PrimitiveNode& primitive : test_support::primitive_nodes()) {
    for (const bool is_signed : {false, true}) {
      for (const char* scale : {"[1]", "[1.4, 0.6, 1]"}) {
        const Leaf leaf = leaf_of(primitive.text("p", is_signed) +
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
  // Its support ends at the plane alone, a range further out.
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
  const Tape both = compile_or_die(read_or_die(scene_of_nodes("[" + nodes + R"({"max": {"children": ["#0", "#1"]}}])")));
  EXPECT_FALSE(both.support.is_bounded());
}

}  // namespace
}  // namespace isofield::blobtree
