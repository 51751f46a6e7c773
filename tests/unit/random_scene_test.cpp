#include "support/random_scene.h"

#include <gtest/gtest.h>

#include <set>

#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"
#include "reference/evaluator.h"

namespace isofield::test_support {
namespace {

TEST(RandomScene, IsAcceptedAndCompiles) {
  int full = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const v1::Scene message = random_scene(seed, {.nodes = static_cast<int>(seed % 200) + 1});
    EXPECT_LE(message.nodes_size(), 260);
    const auto scene = blobtree::read_scene(message);
    ASSERT_TRUE(scene.ok()) << "seed " << seed << ": " << scene.status().message();
    const auto tape = blobtree::compile(*scene);
    ASSERT_TRUE(tape.ok()) << "seed " << seed << ": " << tape.status().message();
    full += tape->support.empty() ? 0 : 1;
  }
  EXPECT_GT(full, 550);
}

TEST(RandomScene, TheSeedDecides) {
  EXPECT_EQ(random_scene(5).SerializeAsString(), random_scene(5).SerializeAsString());
  EXPECT_NE(random_scene(5).SerializeAsString(), random_scene(6).SerializeAsString());
}

TEST(RandomScene, EveryKindOfNodeAppears) {
  std::set<int> kinds, presets;
  bool bulge = false, custom = false, shear = false, shared = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const v1::Scene scene = random_scene(seed, {.nodes = 150});
    std::multiset<std::string> references;
    for (const v1::Node& node : scene.nodes()) {
      kinds.insert(node.kind_case());
      shear |= node.transform().matrix_size() == 12;
      for (const std::string& child : node.max().children()) references.insert(child);
      if (!node.has_gradient()) continue;
      bulge |= node.gradient().silhouette().kind() == v1::Silhouette::BULGE;
      presets.insert(node.gradient().opening().preset());
      custom |= node.gradient().opening().has_w1();
      for (const std::string& child : node.gradient().children()) references.insert(child);
    }
    for (const std::string& r : references) shared |= references.count(r) > 1;
  }
  EXPECT_EQ(kinds.size(), 27u);  // all but custom
  EXPECT_EQ(presets.size(), 4u);
  EXPECT_TRUE(bulge && custom && shear && shared);
}

}  // namespace
}  // namespace isofield::test_support
