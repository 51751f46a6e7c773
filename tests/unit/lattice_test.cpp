#include "blobtree/cull/lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "base/workers.h"
#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/tape_interpreter.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::Random;
using test_support::read_or_die;
using test_support::TapeInterpreter;

using Place = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

std::map<Place, Brick> by_place(const BrickList& list) {
  std::map<Place, Brick> map;
  for (const Brick& b : list.bricks) map.emplace(Place{b.x, b.y, b.z}, b);
  return map;
}

const Lattice kLattice{{-2, -2, -2}, {0.1, 0.11, 0.12}, {41, 37, 30}};

Place brick_of(const dvec3& p, const Lattice& lattice = kLattice) {
  const auto along = [](double x, double origin, double spacing) {
    return static_cast<std::uint32_t>((x - origin) / (spacing * kBrickCells));
  };
  return {along(p.x, lattice.origin.x, lattice.spacing.x), along(p.y, lattice.origin.y, lattice.spacing.y),
          along(p.z, lattice.origin.z, lattice.spacing.z)};
}

dvec3 random_point(Random& random, const Lattice& lattice = kLattice) {
  return {lattice.origin.x + lattice.spacing.x * lattice.cells[0] * random.number(0, 1),
          lattice.origin.y + lattice.spacing.y * lattice.cells[1] * random.number(0, 1),
          lattice.origin.z + lattice.spacing.z * lattice.cells[2] * random.number(0, 1)};
}

TEST(Cull, DroppedBricksHoldNoSurface) {
  int dropped = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Scene scene = read_or_die(test_support::random_scene(seed, {.nodes = 30}));
    const Tape tape = compile_or_die(scene);
    const reference::Evaluator evaluator(scene);
    Random random(seed);
    const double iso = random.chance(0.5) ? 0.5 : random.number(0.1, 0.9);
    const auto list = cull(tape, {.lattice = kLattice, .keep = Keep::kSurface, .iso = iso});
    ASSERT_TRUE(list.ok());
    const auto bricks = by_place(*list);
    ASSERT_EQ(bricks.size(), list->bricks.size()) << "a brick is listed twice";
    std::map<Place, std::pair<bool, bool>> sides;  // for dropped bricks: a point inside, a point outside
    TapeInterpreter interpreter(tape);
    for (int i = 0; i < 1500; ++i) {
      const dvec3 p = random_point(random);
      const double f = evaluator.value(p);
      const auto it = bricks.find(brick_of(p));
      if (it == bricks.end()) {
        ++dropped;
        auto& [inside, outside] = sides[brick_of(p)];
        (f > iso ? inside : outside) = true;
      } else {
        ++kept;
        const std::span<const Instruction> code(&list->code[it->second.tape_begin], it->second.tape_count);
        ASSERT_NEAR(interpreter.evaluate(code, p).field.v, f, 1e-9) << "seed " << seed;
      }
    }
    for (const auto& [place, side] : sides) EXPECT_FALSE(side.first && side.second) << "seed " << seed;
  }
  std::printf("%d points in dropped bricks, %d in kept ones\n", dropped, kept);
  EXPECT_GT(dropped, kept);
}

TEST(Cull, BricksAroundEveryCrossingAreKept) {
  // Bisection finds a crossing between two points; the brick around it must be in the list. The bricks are so small
  // that the field varies little within one, so bounds that are off by a little show.
  const Lattice fine{{-1.5, -1.5, -1.5}, {0.021, 0.02, 0.019}, {143, 150, 157}};
  int crossings = 0;
  for (std::uint64_t seed = 0; seed < 14; ++seed) {
    const Scene scene = read_or_die(test_support::random_scene(seed, {.nodes = 20}));
    const reference::Evaluator evaluator(scene);
    const auto list = cull(compile_or_die(scene), {.lattice = fine});
    ASSERT_TRUE(list.ok());
    const auto bricks = by_place(*list);
    Random random(seed);
    for (int i = 0; i < 400; ++i) {
      dvec3 a = random_point(random, fine), b = random_point(random, fine);
      if ((evaluator.value(a) > 0.5) == (evaluator.value(b) > 0.5)) continue;
      for (int n = 0; n < 40; ++n) {
        const dvec3 c = (a + b) * 0.5;
        ((evaluator.value(c) > 0.5) == (evaluator.value(a) > 0.5) ? a : b) = c;
      }
      ++crossings;
      EXPECT_TRUE(bricks.contains(brick_of(a, fine)) || bricks.contains(brick_of(b, fine))) << "seed " << seed;
    }
  }
  EXPECT_GT(crossings, 200);
}

TEST(Cull, DroppedBricksOfTheSupportHoldNoField) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Scene scene = read_or_die(test_support::random_scene(seed, {.nodes = 15}));
    const reference::Evaluator evaluator(scene);
    const auto list = cull(compile_or_die(scene), {.lattice = kLattice, .keep = Keep::kSupport});
    ASSERT_TRUE(list.ok());
    const auto bricks = by_place(*list);
    Random random(seed);
    for (int i = 0; i < 1000; ++i) {
      const dvec3 p = random_point(random);
      if (!bricks.contains(brick_of(p))) {
        ASSERT_EQ(evaluator.value(p), 0) << "seed " << seed;
      }
    }
  }
}

TEST(Cull, CappedLatticesKeepTheBoundaryOfWhatIsInside) {
  // The ball holds the whole lattice. It has no surface in it, but with a cap the lattice's boundary is a surface.
  const Tape tape =
      compile_or_die(read_or_die(test_support::scene_of_nodes(R"({"sphere": {"radius": 10, "range": 1}})")));
  const Lattice lattice{{-1, -1, -1}, {0.1, 0.1, 0.1}, {20, 12, 13}};  // 5, 3 and 4 bricks
  const auto open = cull(tape, {.lattice = lattice});
  ASSERT_TRUE(open.ok());
  EXPECT_TRUE(open->bricks.empty());
  const auto capped = cull(tape, {.lattice = lattice, .is_capped = true});
  ASSERT_TRUE(capped.ok());
  const auto bricks = by_place(*capped);
  EXPECT_EQ(bricks.size(), 5u * 3 * 4 - 3 * 1 * 2);
  EXPECT_FALSE(bricks.contains({2, 1, 1}));
  EXPECT_TRUE(bricks.contains({4, 2, 3}));
}

std::uint64_t morton(const Brick& b) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 16; ++bit) {
    code |= std::uint64_t{b.x >> bit & 1} << (3 * bit) | std::uint64_t{b.y >> bit & 1} << (3 * bit + 1) |
            std::uint64_t{b.z >> bit & 1} << (3 * bit + 2);
  }
  return code;
}

TEST(Cull, BricksLieInMortonOrderAndWithinTheLattice) {
  const Tape tape = compile_or_die(read_or_die(test_support::random_scene(3)));
  const auto list = cull(tape, {.lattice = kLattice, .keep = Keep::kSupport});
  ASSERT_TRUE(list.ok());
  ASSERT_GT(list->bricks.size(), 10u);
  for (std::size_t i = 0; i < list->bricks.size(); ++i) {
    const Brick& b = list->bricks[i];
    if (i > 0) {
      EXPECT_LT(morton(list->bricks[i - 1]), morton(b));
    }
    EXPECT_LT(b.x * kBrickCells, kLattice.cells[0]);
    EXPECT_LT(b.y * kBrickCells, kLattice.cells[1]);
    EXPECT_LT(b.z * kBrickCells, kLattice.cells[2]);
    EXPECT_LE(b.tape_begin + b.tape_count, list->code.size());
  }
}

TEST(Cull, LimitsAndCancellationAreObeyed) {
  const Tape tape = compile_or_die(read_or_die(test_support::random_scene(3)));
  const auto whole = cull(tape, {.lattice = kLattice, .keep = Keep::kSupport});
  ASSERT_TRUE(whole.ok());
  const auto limited =
      cull(tape, {.lattice = kLattice, .keep = Keep::kSupport, .max_bricks = whole->bricks.size() - 1});
  EXPECT_EQ(limited.status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_TRUE(cull(tape, {.lattice = kLattice, .keep = Keep::kSupport, .max_bricks = whole->bricks.size()}).ok());
  const Lattice fine{{-2, -2, -2}, {0.01, 0.01, 0.01}, {400, 400, 400}};
  const auto cancelled = cull(tape, {.lattice = fine, .cancelled = [] { return true; }});
  EXPECT_EQ(cancelled.status().code(), absl::StatusCode::kCancelled);
}

// Culling on several threads gives the same list, brick by brick and instruction by instruction.
TEST(Cull, ThreadsMakeTheSameList) {
  base::Workers workers(1);
  const Lattice fine{{-2, -2, -2}, {0.02, 0.022, 0.024}, {201, 183, 170}};
  std::size_t shared = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 60})));
    CullRequest request{.lattice = fine, .keep = seed % 2 == 0 ? Keep::kSurface : Keep::kSupport};
    const auto alone = cull(tape, request);
    request.for_each = [&](std::size_t count, const std::function<void(std::size_t)>& work) {
      shared += count;
      workers.for_each(count, work);
    };
    const auto together = cull(tape, request);
    ASSERT_TRUE(alone.ok() && together.ok());
    ASSERT_EQ(alone->bricks.size(), together->bricks.size());
    for (std::size_t i = 0; i < alone->bricks.size(); ++i) {
      const Brick &a = alone->bricks[i], &b = together->bricks[i];
      ASSERT_EQ((std::array{a.x, a.y, a.z, a.tape_count}), (std::array{b.x, b.y, b.z, b.tape_count}));
      ASSERT_EQ(
          std::memcmp(&alone->code[a.tape_begin], &together->code[b.tape_begin], a.tape_count * sizeof(Instruction)),
          0);
    }
    if (alone->bricks.empty()) continue;
    request.max_bricks = alone->bricks.size() - 1;
    EXPECT_TRUE(absl::IsResourceExhausted(cull(tape, request).status()));
  }
  EXPECT_GT(shared, 100u);
  CullRequest cancelled{.lattice = {{-2, -2, -2}, {0.001, 0.001, 0.001}, {4000, 4000, 4000}}};
  cancelled.cancelled = [] { return true; };
  cancelled.for_each = workers.for_each();
  const Tape tape = compile_or_die(read_or_die(test_support::random_scene(3, {.nodes = 60})));
  EXPECT_TRUE(absl::IsCancelled(cull(tape, cancelled).status()));
}

}  // namespace
}  // namespace isofield::blobtree
