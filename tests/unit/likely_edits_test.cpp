#include "engine/likely_edits.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::engine {
namespace {

using test_support::compile_or_die;
using test_support::read_or_die;

// Returns the kinds of a scene's nodes, with the root last.
std::vector<v1::Node::KindCase> kinds_of(const v1::Scene& scene) {
  std::vector<v1::Node::KindCase> kinds;
  for (const v1::Node& node : scene.nodes()) kinds.push_back(node.kind_case());
  return kinds;
}

std::vector<v1::Scene> likely(const std::string& nodes) {
  const v1::Scene scene = test_support::scene_of_nodes(nodes);
  return likely_edits(scene, compile_or_die(read_or_die(scene)));
}

TEST(LikelyEdits, AddToARootOfAnyNumberOfOperands) {
  const std::string spheres = R"({"name": "a", "sphere": {"radius": 1, "range": 0.5}},
    {"name": "b", "sphere": {"radius": 1, "range": 0.5}}, )";
  for (const std::string root : {"sum", "max", "min", "gradient", "ricci"}) {
    const std::string exponent = root == "ricci" ? R"(, "exponent": 4)" : "";
    const auto scenes =
        likely(spheres + R"({"name": "r", ")" + root + R"(": {"children": ["a", "b"])" + exponent + "}}");
    ASSERT_EQ(scenes.size(), 4u);
    EXPECT_EQ(scenes[0].root(), "#2") << root;
    EXPECT_EQ(scenes[0].nodes(3).kind_case(), v1::Node::kBox);
    EXPECT_EQ(scenes[1].nodes(3).kind_case(), v1::Node::kCylinder);
    EXPECT_EQ(scenes[2].nodes(4).difference().children_size(), 2);
    EXPECT_EQ(scenes[3].nodes(4).gradient().children_size(), 2);
    for (const v1::Scene& scene : scenes) compile_or_die(read_or_die(scene));
  }
}

TEST(LikelyEdits, PutABlendOverARootOfOneShape) {
  const auto scenes = likely(R"({"sphere": {"radius": 1, "range": 0.5}})");
  ASSERT_EQ(scenes.size(), 4u);
  using enum v1::Node::KindCase;
  EXPECT_EQ(kinds_of(scenes[0]), (std::vector{kSphere, kBox, kGradient}));
  EXPECT_EQ(kinds_of(scenes[2]), (std::vector{kSphere, kSphere, kDifference}));
}

TEST(LikelyEdits, OfSignedFieldsAreSigned) {
  const auto scenes = likely(R"({"sphere": {"radius": 1, "law": "SIGNED"}})");
  ASSERT_EQ(scenes.size(), 3u);
  for (const v1::Scene& scene : scenes) {
    EXPECT_EQ(compile_or_die(read_or_die(scene)).law, operators::Law::kSigned);
  }
}

TEST(LikelyEdits, OfAnySceneAreScenes) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const v1::Scene scene = test_support::random_scene(seed, {.nodes = 1 + static_cast<int>(seed % 30)});
    const blobtree::Tape tape = compile_or_die(read_or_die(scene));
    for (const v1::Scene& next : likely_edits(scene, tape)) {
      const blobtree::Tape more = compile_or_die(read_or_die(next));
      EXPECT_TRUE(more.codes.operands.contains(tape.codes.operands)) << seed;
      EXPECT_EQ(more.law, tape.law) << seed;
    }
  }
}

}  // namespace
}  // namespace isofield::engine
