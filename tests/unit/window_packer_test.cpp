#include "blobtree/tape/window_packer.h"

#include <gtest/gtest.h>

#include <cstring>

#include "blobtree/primitives/leaf.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using test_support::compile_or_die;
using test_support::Random;
using test_support::read_or_die;

// Makes a scene of `count` spheres and segments under one maximum.
Tape many_leaves(int count) {
  Random random(1);
  v1::Scene scene;
  v1::Node root;
  for (int i = 0; i < count; ++i) {
    v1::Node& node = *scene.add_nodes();
    const auto point = [&](auto* to) {
      for (int a = 0; a < 3; ++a) to->Add(random.number(-50, 50));
    };
    if (i % 2 == 0) {
      point(node.mutable_sphere()->mutable_center());
      node.mutable_sphere()->set_radius(1);
      node.mutable_sphere()->set_range(1);
    } else {
      point(node.mutable_segment()->mutable_a());
      point(node.mutable_segment()->mutable_b());
      node.mutable_segment()->set_radius_a(1);
      node.mutable_segment()->set_radius_b(1);
      node.mutable_segment()->set_range(1);
    }
    root.mutable_max()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = root;
  return compile_or_die(read_or_die(scene));
}

// Compares what the device reads of a window: its instructions, each with the records that it names.
void expect_same(const Tape& tape, const ParameterBuffers& whole, const Instruction& original,
                 const std::vector<Float4>& data, const Window& window, std::uint32_t place) {
  Instruction packed;
  std::memcpy(&packed, &data[window.code + place], sizeof packed);
  EXPECT_EQ(packed.code, original.code);
  const auto same = [&](std::uint32_t at, std::uint32_t part, const std::vector<Float4>& from, std::uint32_t record,
                        std::uint32_t size) {
    const Float4* found = part == Window::kWhole ? &from[at] : &data[part + at];
    EXPECT_EQ(std::memcmp(found, &from[record], size * sizeof(Float4)), 0);
    EXPECT_LE(at + size, kWindowSize);
  };
  if (original.is_leaf()) {
    same(packed.leaf, window.leaves, whole.leaves, original.leaf, record_size(original.operand()));
  }
  if (original.op() != operators::Opcode::kPush) {
    const Operation& o = tape.operation(original);
    same(packed.operation - o.frame_size(), window.operations, whole.operations, original.operation - o.frame_size(),
         operation_record_size(o));
  }
}

TEST(WindowPacker, WindowsHoldWhatTheirInstructionsName) {
  for (const int count : {10, 3000}) {  // leaves that fit a window, and leaves that do not
    const Tape tape = many_leaves(count);
    const ParameterBuffers parameters = lay_out(tape);
    WindowPacker packer(tape, parameters, tape.code);
    struct Added {
      std::uint32_t begin, count, window, place;
    };
    std::vector<Added> added;
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
      const auto length = static_cast<std::uint32_t>(random.integer(1, std::min(count, 40)));
      const auto begin = static_cast<std::uint32_t>(random.integer(0, count - static_cast<int>(length)));
      std::uint32_t place = begin;
      const std::uint32_t window = packer.add(place, length);
      ASSERT_NE(window, WindowPacker::kNoWindow);
      if (!added.empty()) {
        ASSERT_GE(window, added.back().window);
        ASSERT_LE(window, added.back().window + 1);
      }
      added.push_back({begin, length, window, place});
    }
    const std::vector<Float4> data = packer.finish();
    ASSERT_EQ(packer.windows().size(), added.back().window + 1);
    EXPECT_GT(packer.windows().size(), 2u);
    for (const Window& w : packer.windows()) {
      EXPECT_EQ(w.code % kWindowAlignment, 0u);
      EXPECT_EQ(w.leaves == Window::kWhole, count == 10);
    }
    for (const Added& a : added) {
      for (std::uint32_t n = 0; n < a.count; ++n) {
        expect_same(tape, parameters, tape.code[a.begin + n], data, packer.windows()[a.window], a.place + n);
      }
    }
  }
}

TEST(WindowPacker, NeighboursShareATape) {
  const Tape tape = many_leaves(10);
  const ParameterBuffers parameters = lay_out(tape);
  WindowPacker packer(tape, parameters, tape.code);
  std::uint32_t first = 2, second = 2;
  packer.add(first, 5);
  packer.add(second, 5);
  EXPECT_EQ(first, second);
}

TEST(WindowPacker, ATapeLongerThanAWindowStaysWhereItIs) {
  const Tape tape = many_leaves(5000);
  const ParameterBuffers parameters = lay_out(tape);
  WindowPacker packer(tape, parameters, tape.code);
  std::uint32_t begin = 7;
  EXPECT_EQ(packer.add(begin, 4900), WindowPacker::kNoWindow);
  EXPECT_EQ(begin, 7u);
  EXPECT_EQ(packer.add(begin, 3), 0u);
}

}  // namespace
}  // namespace isofield::blobtree
