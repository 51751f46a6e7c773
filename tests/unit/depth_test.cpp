// Tests trees that are far deeper, or nodes that are far wider, than a recursion on the call stack could handle.
#include <gtest/gtest.h>

#include <string>

#include "blobtree/cull/pruner.h"
#include "blobtree/scene/scene_reader.h"
#include "blobtree/tape/compiler.h"
#include "reference/evaluator.h"
#include "support/scene_text.h"
#include "support/tape_interpreter.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::place;
using test_support::read_or_die;

v1::Node sphere_node(double x) {
  v1::Node node;
  node.mutable_sphere()->add_center(x);
  node.mutable_sphere()->add_center(0);
  node.mutable_sphere()->add_center(0);
  node.mutable_sphere()->set_radius(0.5);
  node.mutable_sphere()->set_range(0.5);
  return node;
}

// Returns a chain of operators, each over one sphere and the chain below it.
v1::Scene chain(int depth, bool left_deep, double spacing) {
  v1::Scene scene;
  *scene.add_nodes() = sphere_node(0);
  std::string below = "#0";
  for (int i = 1; i < depth; ++i) {
    *scene.add_nodes() = sphere_node(i * spacing);
    const std::string leaf = place(2 * i - 1);
    auto& children = *scene.add_nodes()->mutable_gradient()->mutable_children();
    *children.Add() = left_deep ? below : leaf;
    *children.Add() = left_deep ? leaf : below;
    below = place(2 * i);
  }
  return scene;
}

TEST(Depth, ChainsOfAHundredThousandAreReadAndCompiled) {
  for (const bool left_deep : {true, false}) {
    const Scene scene = read_or_die(chain(100'000, left_deep, 0.001));
    EXPECT_EQ(scene.order.size(), 199'999u);
    const Tape tape = compile_or_die(scene);
    EXPECT_EQ(tape.leaves.size(), 100'000u);
    EXPECT_EQ(tape.stack_depth, 0u);
  }
}

TEST(Depth, ChainsOfTransformsAreReadAndCompiled) {
  v1::Scene message;
  *message.add_nodes() = sphere_node(0);
  for (int i = 0; i < 100'000; ++i) {
    v1::Transform& t = *message.add_nodes()->mutable_transform();
    t.set_child(place(i));
    for (const double x : {1e-3, 0.0, 0.0}) t.add_translation(x);
  }
  const Scene scene = read_or_die(message);
  const Tape tape = compile_or_die(scene);
  EXPECT_NEAR(tape.leaves.at(0).domain.anchor.x, 100, 1e-6);
  EXPECT_NEAR(reference::Evaluator(scene).value({100.5, 0, 0}), 0.5, 1e-6);
}

TEST(Depth, TheReferenceFollowsDeepTrees) {
  for (const bool left_deep : {true, false}) {
    const Scene scene = read_or_die(chain(5'000, left_deep, 0.25));
    const reference::Evaluator evaluator(scene);
    const Tape tape = compile_or_die(scene);
    test_support::TapeInterpreter interpreter(tape);
    for (const double x : {-0.4, 0.0, 100.1, 777.77, 1249.9}) {
      const double value = evaluator.value({x, 0.45, 0});
      EXPECT_GT(value, 0);
      EXPECT_NEAR(value, interpreter.evaluate(tape.code, {x, 0.45, 0}).field.v, 1e-9);
    }
    EXPECT_EQ(evaluator.value({2000, 0, 0}), 0);
  }
}

TEST(Depth, WideNodesFoldAndPrune) {
  for (const char* kind : {"sum", "gradient", "difference"}) {
    v1::Scene message;
    v1::Node wide;
    for (int i = 0; i < 5'000; ++i) {
      *message.add_nodes() = sphere_node(i * 0.25);
      const std::string child = place(i);
      if (std::string(kind) == "sum") wide.mutable_sum()->add_children(child);
      if (std::string(kind) == "gradient") wide.mutable_gradient()->add_children(child);
      if (std::string(kind) == "difference") wide.mutable_difference()->add_children(child);
    }
    *message.add_nodes() = wide;
    const Scene scene = read_or_die(message);
    const reference::Evaluator evaluator(scene);
    const Tape tape = compile_or_die(scene);
    EXPECT_EQ(tape.stack_depth, 0u);
    test_support::TapeInterpreter interpreter(tape);
    const dvec3 p{kind == std::string("difference") ? -0.4 : 600.0, 0.3, 0};
    EXPECT_GT(evaluator.value(p), 0);
    EXPECT_NEAR(evaluator.value(p), interpreter.evaluate(tape.code, p).field.v, 1e-9);

    std::vector<Instruction> pruned;
    Pruner pruner(tape);
    pruner.prune(tape.code, 0, tape.code.size(), {p - dvec3{0.1, 0.1, 0.1}, p + dvec3{0.1, 0.1, 0.1}}, pruned);
    EXPECT_LT(pruned.size(), 20u);
    EXPECT_EQ(interpreter.evaluate(pruned, p).field.v, interpreter.evaluate(tape.code, p).field.v);
  }
}

}  // namespace
}  // namespace isofield::blobtree
