#include "blobtree/cull/pruner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/tape_interpreter.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::Random;
using test_support::read_or_die;
using test_support::scene_of_nodes;
using test_support::TapeInterpreter;

Box random_box(Random& random) {
  const dvec3 centre = random.point(-1.6, 1.6);
  const double size = random.chance(0.1) ? 0 : std::exp(random.number(-4, 0.5));
  const dvec3 half{size * random.number(0.3, 1), size * random.number(0.3, 1), size * random.number(0.3, 1)};
  return {centre - half, centre + half};
}

dvec3 random_point_in(Random& random, const Box& box) {
  const auto within = [&](double low, double high) {
    const double at = random.number(-0.2, 1.2);  // some points lie on corners and faces
    return low + (high - low) * std::clamp(at, 0.0, 1.0);
  };
  return {within(box.min.x, box.max.x), within(box.min.y, box.max.y), within(box.min.z, box.max.z)};
}

struct Totals {
  std::size_t whole = 0, pruned = 0;
  int empty = 0, boxes = 0;
};

// Checks that bounds hold, and that pruned code gives the same bits at random points of random boxes. Pruned code that
// is pruned again must give them, too.
void check_scene(std::uint64_t seed, const Scene& scene, Totals& totals) {
  const Tape tape = compile_or_die(scene);
  const reference::Evaluator evaluator(scene);
  TapeInterpreter interpreter(tape);
  Pruner pruner(tape);
  Random random(seed);
  for (int n = 0; n < 12; ++n) {
    const Box box = random_box(random);
    std::vector<Instruction> pruned;
    const auto [range, is_zero] = pruner.prune(tape.code, 0, tape.code.size(), box, pruned);
    const dvec3 quarter = (box.max - box.min) * 0.25;
    const Box inner{box.min + quarter, box.max - quarter};
    std::vector<Instruction> arena = pruned;
    const Interval inner_range = pruner.prune(arena, 0, pruned.size(), inner, arena).range;
    const std::vector<Instruction> twice(arena.begin() + static_cast<std::ptrdiff_t>(pruned.size()), arena.end());
    ++totals.boxes;
    totals.whole += tape.code.size();
    totals.pruned += pruned.size();
    totals.empty += pruned.empty() ? 1 : 0;
    EXPECT_EQ(pruned.empty(), is_zero);
    for (int i = 0; i < 12; ++i) {
      const bool deep = i % 3 == 0;
      const dvec3 p = random_point_in(random, deep ? inner : box);
      const double whole = interpreter.evaluate(tape.code, p).field.v, value = evaluator.value(p);
      ASSERT_EQ(interpreter.evaluate(pruned, p).field.v, whole) << "seed " << seed << " box " << n;
      ASSERT_NEAR(value, whole, 1e-9);
      ASSERT_GE(value, range.lo) << "seed " << seed << " box " << n;
      ASSERT_LE(value, range.hi) << "seed " << seed << " box " << n;
      if (deep) {
        ASSERT_EQ(interpreter.evaluate(twice, p).field.v, whole) << "seed " << seed << " box " << n;
        ASSERT_GE(value, inner_range.lo) << "seed " << seed << " box " << n;
        ASSERT_LE(value, inner_range.hi);
      }
    }
  }
}

TEST(Pruner, BoundsHoldAndPrunedTapesGiveTheSameBits) {
  Totals totals;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    const int nodes = 1 + static_cast<int>(seed * 7 % 80);
    check_scene(seed, read_or_die(test_support::random_scene(seed, {.nodes = nodes})), totals);
    if (HasFatalFailure()) return;
  }
  std::printf("%d boxes, %d of them empty; %.1f instructions pruned to %.1f\n", totals.boxes, totals.empty,
              static_cast<double>(totals.whole) / totals.boxes, static_cast<double>(totals.pruned) / totals.boxes);
  EXPECT_LT(totals.pruned * 2, totals.whole);
}

// The scenes nest sums, maxima and gradient blends of every opening and silhouette.
TEST(Pruner, BoundsOfGradientBlendsHold) {
  Totals totals;
  for (std::uint64_t seed = 1000; seed < 1150; ++seed) {
    const int nodes = 2 + static_cast<int>(seed % 30);
    check_scene(seed,
                read_or_die(test_support::random_scene(seed, {.nodes = nodes, .cuts = false, .all_operators = false})),
                totals);
    if (HasFatalFailure()) return;
  }
  EXPECT_LT(totals.pruned * 2, totals.whole);
}

TEST(Pruner, GradientsOfPrunedTapesAreTheSameToo) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 30, .cuts = false})));
    TapeInterpreter interpreter(tape);
    Pruner pruner(tape);
    Random random(seed);
    for (int n = 0; n < 10; ++n) {
      const Box box = random_box(random);
      std::vector<Instruction> pruned;
      pruner.prune(tape.code, 0, tape.code.size(), box, pruned);
      for (int i = 0; i < 5; ++i) {
        const dvec3 p = random_point_in(random, box);
        ASSERT_EQ(interpreter.evaluate(pruned, p).field.d, interpreter.evaluate(tape.code, p).field.d) << seed;
      }
    }
  }
}

std::vector<Instruction> prune(const Tape& tape, const Box& box) {
  std::vector<Instruction> out;
  Pruner(tape).prune(tape.code, 0, tape.code.size(), box, out);
  return out;
}

TEST(Pruner, FieldsAboveOneAreClampedWhereTheSubtrahendIsGone) {
  const std::string nodes = R"({"sphere": {"radius": 0.5, "range": 0.5}},
    {"sphere": {"center": [3,0,0], "radius": 0.5, "range": 0.5}}, {"sphere": {"center": [3.2,0,0], "radius": 0.5, "range": 0.5}},
    {"sum": {"children": ["#0","#0","#0"]}}, {"sum": {"children": ["#1","#2"]}}, )";
  for (const char* operands : {R"("#3","#1")", R"("#3","#4")", R"("#0","#4")"}) {
    SCOPED_TRACE(operands);
    const Tape tape = compile_or_die(read_or_die(scene_of_nodes(nodes + R"({"difference": {"children": [)" + operands +
                                                                "]}}, {\"sum\": {\"children\": [\"#5\",\"#5\"]}}")));
    const std::vector<Instruction> pruned = prune(tape, {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}});
    TapeInterpreter interpreter(tape);
    const dvec3 p{0.05, 0, 0};
    EXPECT_EQ(interpreter.evaluate(pruned, p).field.v, interpreter.evaluate(tape.code, p).field.v);
    EXPECT_NEAR(interpreter.evaluate(pruned, p).field.v, 2, 0.1);
    for (const Instruction& i : pruned) {
      EXPECT_TRUE(tape.codes.opcodes.has(i.op()));
      EXPECT_TRUE(tape.codes.operands.has(i.operand()));
    }
  }
}

TEST(Pruner, OpcodesOfPrunedTapesAreInTheSets) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 25})));
    Random random(seed);
    for (int n = 0; n < 10; ++n) {
      for (const Instruction& i : prune(tape, random_box(random))) {
        ASSERT_TRUE(tape.codes.opcodes.has(i.op())) << "seed " << seed;
        ASSERT_TRUE(tape.codes.operands.has(i.operand())) << "seed " << seed;
      }
    }
  }
}

TEST(Pruner, NothingIsLeftFarAway) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed)));
    EXPECT_TRUE(prune(tape, {{100, 100, 100}, {200, 200, 200}}).empty());
  }
}

}  // namespace
}  // namespace isofield::blobtree
