#include "blobtree/tape/compiler.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "blobtree/scene/scene_reader.h"
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

const std::string kFour = R"({"sphere": {"radius": 0.5, "range": 0.5}},
  {"box": {"center": [0.3,0,0], "half_size": [0.4,0.3,0.2], "range": 0.3}},
  {"torus": {"major_radius": 0.5, "minor_radius": 0.2, "range": 0.4}},
  {"ellipsoid": {"center": [0,0.3,0.1], "semi_axes": [0.5,0.4,0.3], "range": 0.3}}, )";

void expect_tape_is_scene(const Scene& scene, std::uint64_t seed, int points, double spread) {
  const Tape tape = compile_or_die(scene);
  const reference::Evaluator evaluator(scene);
  TapeInterpreter interpreter(tape);
  Random random(seed);
  for (int i = 0; i < points; ++i) {
    const dvec3 p = random.point(-spread, spread);
    const reference::FieldState a = evaluator.state(p), b = interpreter.evaluate(tape.code, p);
    ASSERT_NEAR(a.field.v, b.field.v, 1e-9) << "seed " << seed;
    if (a.field.v > 0) {
      ASSERT_TRUE(tape.support.touches({p, p})) << "seed " << seed;
    }
  }
  EXPECT_EQ(interpreter.most_waiting(), tape.stack_depth) << "seed " << seed;
}

TEST(Compiler, TapesEvaluateLikeTheirScenes) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const int nodes = 1 + static_cast<int>(seed % 60);
    expect_tape_is_scene(read_or_die(test_support::random_scene(seed, {.nodes = nodes})), seed, 30, 1.6);
  }
}

TEST(Compiler, DeepSecondOperandsGoFirstAndDifferencesAreTurnedAround) {
  // The scene is #0 - (#1 + (#2 - #3)). Postfix code without exchange would keep values waiting.
  const Scene scene = read_or_die(scene_of_nodes(kFour + R"({"difference": {"children": ["#2","#3"]}},
    {"sum": {"children": ["#1","#4"]}}, {"difference": {"children": ["#0","#5"]}})"));
  const Tape tape = compile_or_die(scene);
  EXPECT_EQ(tape.stack_depth, 0u);
  EXPECT_EQ(tape.code.back().op(), operators::Opcode::kSubtractFrom);
  expect_tape_is_scene(scene, 1, 500, 1.2);
}

TEST(Compiler, ComplexOperandsOfADifferenceKeepTheirSides) {
  const Scene scene = read_or_die(scene_of_nodes(kFour + R"({"sum": {"children": ["#0","#1"]}},
    {"max": {"children": ["#2","#3"]}}, {"difference": {"children": ["#4","#5"]}})"));
  EXPECT_EQ(compile_or_die(scene).stack_depth, 1u);
  expect_tape_is_scene(scene, 2, 500, 1.2);
}

TEST(Compiler, OpcodeSetsHoldWhatPruningMayMakeOfATape) {
  // Pruning turns f - 0 with f > 1 into a clamping instruction that the whole tape need not hold (pruner.cpp).
  const Tape tape = compile_or_die(read_or_die(scene_of_nodes(kFour + R"({"sum": {"children": ["#1","#2"]}},
    {"difference": {"children": ["#0","#4"]}})")));
  EXPECT_TRUE(tape.codes.opcodes.has(operators::Opcode::kSubtractFrom));
  EXPECT_TRUE(tape.codes.opcodes.has(operators::Opcode::kSubtract));
  EXPECT_TRUE(tape.codes.operands.has(Operand::kZero));
}

TEST(Compiler, LengthIsTheLargestRangeBelowInTheWorld) {
  const Tape tape = compile_or_die(read_or_die(scene_of_nodes(
      R"({"sphere": {"radius": 0.5, "range": 0.25}}, {"sphere": {"radius": 0.5, "range": 0.5}},
         {"transform": {"child": "#1", "scale": [3]}}, {"transform": {"child": "#1", "scale": [9,4,8]}},
         {"gradient": {"children": ["#0","#2"]}}, {"gradient": {"children": ["#4","#3"]}})")));
  ASSERT_EQ(tape.operations.size(), 2u);
  EXPECT_NEAR(tape.operations[0].length, 2.0, 1e-12);  // the outer one comes first
  EXPECT_NEAR(tape.operations[1].length, 1.5, 1e-12);
}

TEST(Compiler, SingleChildrenPassThrough) {
  const Scene scene = read_or_die(scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}},
    {"ricci": {"children": ["#0"], "exponent": 3}}, {"gradient": {"children": ["#1"]}}, {"min": {"children": ["#2"]}})"));
  EXPECT_EQ(compile_or_die(scene).code.size(), 1u);
  expect_tape_is_scene(scene, 3, 50, 0.9);
}

TEST(Compiler, DisjointIntersectionHasNoSupport) {
  const Tape tape = compile_or_die(read_or_die(scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}},
    {"sphere": {"center": [5,0,0], "radius": 0.5, "range": 0.5}}, {"min": {"children": ["#0","#1"]}})")));
  EXPECT_TRUE(tape.support.empty());
}

// Two spheres below a transform, joined by the operator `join`.
Tape transformed(const std::string& join, const std::string& transform) {
  return compile_or_die(read_or_die(
      scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}},
    {"sphere": {"center": [0.5,0,0], "radius": 0.5, "range": 0.5}}, {)" +
                     join + R"(: {"children": ["#0","#1"]}}, {"transform": {"child": "#2", )" + transform + "}}")));
}

TEST(Compiler, OnlyMapsThatChangeAnglesAboveBlendsThatFollowThemMakeFrames) {
  const auto has_frames = [](const Tape& tape) {
    EXPECT_EQ((tape.codes.flags & Codes::kFramed) != 0, tape.operations[0].frame.has_value());
    return tape.operations[0].frame.has_value();
  };
  EXPECT_TRUE(has_frames(transformed(R"("gradient")", R"("scale": [2,1,1])")));
  EXPECT_TRUE(has_frames(transformed(R"("gradient")", R"("matrix": [1,0.1,0,0, 0,1,0,0, 0,0,1,0])")));
  EXPECT_FALSE(has_frames(transformed(R"("gradient")", R"("scale": [2,2,-2], "rotation": [1,2,3,40])")));
  EXPECT_FALSE(has_frames(transformed(R"("sum")", R"("scale": [2,1,1])")));
  // A scale below the blend leaves the blend's own gradients as they are, so it needs no frame.
  const Tape below = compile_or_die(read_or_die(scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}},
    {"transform": {"child": "#0", "scale": [2,1,1]}}, {"gradient": {"children": ["#0","#1"]}})")));
  EXPECT_FALSE(has_frames(below));
}

TEST(Compiler, NullGradientsAreMeasuredInTheUnitOfTheBlendsFrame) {
  const auto length = [](const Tape& tape) { return tape.operations[0].length; };
  EXPECT_DOUBLE_EQ(length(transformed(R"("gradient")", R"("scale": 3)")), 1.5);
  EXPECT_DOUBLE_EQ(length(transformed(R"("gradient")", R"("scale": [3,1,1])")), 0.5);
}

// Returns a full binary tree over 2^levels spheres.
std::string full_tree(int levels) {
  std::string nodes;
  const int leaves = 1 << levels;
  for (int i = 0; i < leaves; ++i) nodes += R"({"sphere": {"radius": 0.5, "range": 0.5}},)";
  for (int i = 0; i + 1 < leaves; ++i) {
    absl::StrAppend(&nodes, R"({"max": {"children": ["#)", 2 * i, R"(", "#)", 2 * i + 1, R"("]}})",
                    i + 2 < leaves ? "," : "");
  }
  return nodes;
}

TEST(Compiler, FullTreesNeedFewRegisters) {
  for (int levels = 1; levels <= 10; ++levels) {
    const Tape tape = compile_or_die(read_or_die(scene_of_nodes(full_tree(levels))));
    EXPECT_EQ(tape.stack_depth, static_cast<std::uint32_t>(levels - 1));
    EXPECT_EQ(tape.leaves.size(), std::size_t{1} << levels);
  }
}

TEST(Compiler, NestedWeightsThatLeaveFloat32AreRefused) {
  std::string nodes = R"({"sphere": {"radius": 1, "law": "SIGNED"}})";
  const auto add = [&](int level) {
    absl::StrAppend(&nodes,
                    level % 2 == 0 ? R"(, {"bt2": {"r1": 1, "r2": 1, "m1": 1e-3)"
                                   : R"(, {"btk": {"ranges": [1], "weights": [1e-3, 1])",
                    R"(, "children": ["#)", level, R"(", "#0"]}})");
    return compile(test_support::read_or_die(test_support::scene_of_nodes(nodes)));
  };
  for (int level = 0; level < 3; ++level) EXPECT_TRUE(add(level).ok()) << level;
  const auto tape = add(3);
  ASSERT_FALSE(tape.ok());
  const std::string text(tape.status().message());
  EXPECT_NE(text.find("nodes[4]: its weights and those of blends below divide a field by 1e-12"), std::string::npos)
      << text;
  EXPECT_NE(text.find("at least 1e-09"), std::string::npos) << text;
  // A field that is made positive is at most 1, so the count of weights begins anew.
  nodes += R"(, {"soften": {"child": "#3", "range": 1}}, {"harden": {"child": "#5"}})";
  nodes += R"(, {"bt2": {"r1": 1, "r2": 1, "m1": 1e-3, "children": ["#6", "#0"]}})";
  EXPECT_TRUE(compile(test_support::read_or_die(test_support::scene_of_nodes(nodes))).ok());
}

TEST(Compiler, TooManyWaitingValuesAreRefused) {
  // The compiler does not put third children first, so each level keeps one value waiting.
  std::string nodes = kFour;
  for (int i = 0; i < 20; ++i) {
    absl::StrAppend(&nodes, R"({"max": {"children": ["#1","#2","#)", i == 0 ? 0 : 3 + i, R"("]}})", i < 19 ? "," : "");
  }
  const auto scene = read_scene(scene_of_nodes(nodes));
  ASSERT_TRUE(scene.ok());
  const auto tape = compile(*scene);
  ASSERT_FALSE(tape.ok());
  EXPECT_EQ(tape.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(std::string(tape.status().message()).find("nodes[23]"), std::string::npos);
}

}  // namespace
}  // namespace isofield::blobtree
