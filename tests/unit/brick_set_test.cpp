#include "blobtree/geometry/brick_set.h"

#include <gtest/gtest.h>

#include "blobtree/cull/lattice.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::Random;

BrickSet random_set(Random& random) {
  BrickBox box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = static_cast<std::uint32_t>(random.integer(0, 4));
    box.high[a] = box.low[a] + static_cast<std::uint32_t>(random.integer(1, 5));
  }
  if (random.chance(0.3)) return box;
  return BrickSet(box, [&](std::uint32_t, std::uint32_t, std::uint32_t) { return random.chance(0.2); });
}

template <class Visit>
void for_each_place(const Visit& visit) {
  for (std::uint32_t z = 0; z < 14; ++z) {
    for (std::uint32_t y = 0; y < 14; ++y) {
      for (std::uint32_t x = 0; x < 14; ++x) visit(x, y, z);
    }
  }
}

TEST(BrickSet, GrowsAroundEveryMember) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const BrickSet set = random_set(random);
    const auto below = static_cast<std::uint32_t>(random.integer(0, 3));
    const auto above = static_cast<std::uint32_t>(random.integer(0, 3));
    const BrickSet grown = set.grown(below, above);
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      bool expected = false;
      // A member reaches `below` bricks down, so the loop looks for members as far up.
      for (std::uint32_t u = x - std::min(x, above); u <= x + below; ++u) {
        for (std::uint32_t v = y - std::min(y, above); v <= y + below; ++v) {
          for (std::uint32_t w = z - std::min(z, above); w <= z + below; ++w) expected |= set.contains(u, v, w);
        }
      }
      ASSERT_EQ(grown.contains(x, y, z), expected) << x << ", " << y << ", " << z;
    });
  }
}

TEST(BrickSet, JoinedHoldsWhatEitherHolds) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const BrickSet a = random_set(random), b = random_set(random);
    const BrickSet joined = a.joined(b);
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      ASSERT_EQ(joined.contains(x, y, z), a.contains(x, y, z) || b.contains(x, y, z));
    });
  }
}

TEST(BrickSet, OfTooManyBricksIsTheirBox) {
  const auto none = [](std::uint32_t, std::uint32_t, std::uint32_t) { return false; };
  EXPECT_FALSE(BrickSet(BrickBox{{0, 0, 0}, {9, 9, 9}}, none).contains(1, 2, 3));
  EXPECT_TRUE(BrickSet(BrickBox{{0, 0, 0}, {~0u, ~0u, ~0u}}, none).contains(1, 2, 3));
  EXPECT_FALSE(BrickSet(BrickBox{}).grown(0, 0).contains(0, 0, 0));
}

TEST(BrickSet, OfALeafHoldsTheBricksWhoseTapesHaveIt) {
  const Lattice lattice{{-2, -2, -2}, {0.1, 0.11, 0.12}, {41, 37, 30}};
  std::size_t with = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Tape tape = test_support::compile_or_die(test_support::read_or_die(
        test_support::random_scene(seed, {.nodes = 20, .cuts = false, .all_operators = false})));
    if (tape.law != operators::Law::kPositive) continue;
    const auto list = cull(tape, {.lattice = lattice, .keep = Keep::kSupport});
    ASSERT_TRUE(list.ok());
    std::vector<BrickSet> sets;
    for (const Leaf& leaf : tape.leaves) sets.push_back(bricks_of(leaf, lattice));
    for (const Brick& b : list->bricks) {
      std::vector<bool> named(tape.leaves.size());
      for (std::uint32_t i = 0; i < b.tape_count; ++i) {
        const Instruction& instruction = list->code[b.tape_begin + i];
        if (instruction.is_leaf()) named[instruction.index] = true;
      }
      for (std::size_t leaf = 0; leaf < named.size(); ++leaf) {
        const bool is_in = sets[leaf].contains(b.x, b.y, b.z);
        EXPECT_TRUE(is_in || !named[leaf]) << "seed " << seed << ", leaf " << leaf;
        (is_in ? with : without) += 1;
      }
    }
  }
  EXPECT_GT(with, 1000u);
  EXPECT_GT(without, with);
}

}  // namespace
}  // namespace isofield::blobtree
