#include "blobtree/tape/parameter_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "blobtree/primitives/falloff.h"
#include "support/primitive_nodes.h"
#include "support/random_scene.h"
#include "support/scene_text.h"

namespace isofield::blobtree {
namespace {

using google::protobuf::FieldDescriptor;
using test_support::compile_or_die;
using test_support::read_or_die;
using test_support::scene_of_nodes;

Tape tape_of(const v1::Scene& scene) {
  return compile_or_die(read_or_die(scene));
}

bool same_bytes(const std::vector<Float4>& a, const std::vector<Float4>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Float4)) == 0;
}

// Expects that two buffers differ in [begin, end) and nowhere else.
void expect_change_within(const std::vector<Float4>& a, const std::vector<Float4>& b, std::size_t begin,
                          std::size_t end) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_LE(end, a.size());
  bool has_changed = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool is_same = std::memcmp(&a[i], &b[i], sizeof(Float4)) == 0;
    has_changed |= !is_same;
    EXPECT_TRUE(is_same || (i >= begin && i < end))
        << "vec4 " << i << ", the record is [" << begin << ", " << end << ")";
  }
  EXPECT_TRUE(has_changed) << "the record is [" << begin << ", " << end << ")";
}

// Calls visit(change) for each number that is stated in a message; change(message) moves that number a little.
template <class Visit>
void for_each_number(const google::protobuf::Message& message, const Visit& visit) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
    const int count = field->is_repeated() ? message.GetReflection()->FieldSize(message, field) : 1;
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE(testing::Message() << field->full_name() << " " << i);
      visit([field, i](google::protobuf::Message& to) {
        const auto* reflection = to.GetReflection();
        // No number of the test scenes is this function's fixed point, -0.192.
        const auto moved = [](double x) { return x * 1.0625 + 0.012; };
        if (field->is_repeated()) {
          reflection->SetRepeatedDouble(&to, field, i, moved(reflection->GetRepeatedDouble(to, field, i)));
        } else {
          reflection->SetDouble(&to, field, moved(reflection->GetDouble(to, field)));
        }
      });
    }
  }
}

// The kind's own message within a node.
google::protobuf::Message& kind_of(v1::Node& node) {
  const auto* const field = node.GetReflection()->GetOneofFieldDescriptor(node, node.GetDescriptor()->oneof_decl(0));
  return *node.GetReflection()->MutableMessage(&node, field);
}

TEST(ParameterLayout, EveryNumberOfAPrimitiveLiesInItsOwnRecord) {
  for (const test_support::PrimitiveNode& primitive : test_support::primitive_nodes()) {
    for (const bool is_signed : {false, true}) {
      const std::string ball = is_signed ? R"({"sphere": {"radius": 0.5, "law": "SIGNED"}})"
                                         : R"({"sphere": {"radius": 0.5, "range": 0.5}})";
      v1::Scene scene = scene_of_nodes(ball + ", " + primitive.text("it", is_signed) + ", " + ball +
                                       R"(, {"max": {"children": ["#0", "it", "#2"]}})");
      const Tape before = tape_of(scene);
      const ParameterBuffers buffers = lay_out(before);
      const auto leaf =
          std::find_if(before.leaves.begin(), before.leaves.end(), [](const Leaf& l) { return l.node == 1; });
      ASSERT_NE(leaf, before.leaves.end());
      int numbers = 0;
      for_each_number(kind_of(*scene.mutable_nodes(1)), [&](const auto& change) {
        v1::Scene edited = scene;
        change(kind_of(*edited.mutable_nodes(1)));
        const Tape after = tape_of(edited);
        ASSERT_EQ(before.leaf_records, after.leaf_records);
        const ParameterBuffers moved = lay_out(after);
        expect_change_within(buffers.leaves, moved.leaves, leaf->record, leaf->record + record_size(leaf->operand));
        EXPECT_TRUE(same_bytes(buffers.operations, moved.operations));
        EXPECT_TRUE(same_bytes(buffers.tables, moved.tables));
        ++numbers;
      });
      EXPECT_GE(numbers, 3) << primitive.kind;
    }
  }
}

const Operation& operation_of_node(const Tape& tape, std::uint32_t node) {
  const auto it =
      std::find_if(tape.operations.begin(), tape.operations.end(), [&](const Operation& o) { return o.node == node; });
  EXPECT_NE(it, tape.operations.end());
  return it == tape.operations.end() ? tape.operations.front() : *it;
}

TEST(ParameterLayout, EveryNumberOfAnOperatorLiesInItsOwnRecord) {
  const char* const positive = R"({"sphere": {"radius": 0.5, "range": 0.5}})";
  const char* const is_signed = R"({"sphere": {"radius": 0.5, "law": "SIGNED"}})";
  const struct {
    const char* leaf;
    const char* node;
  } cases[] = {
      {positive, R"({"ricci": {"children": ["#0", "#1"], "exponent": 3}})"},
      {positive, R"({"barthe": {"children": ["#0", "#1"], "theta1": 10, "theta2": 20}})"},
      {positive, R"({"bernhardt": {"children": ["#0", "#1"], "theta1": 10, "theta2": 20, "weight": 0.25}})"},
      {is_signed, R"({"pasko": {"children": ["#0", "#1"], "a0": -0.25, "a1": 1, "a2": 0.5}})"},
      {is_signed, R"({"superelliptic": {"children": ["#0", "#1"], "exponent": 2, "ranges": [0.5, 1]}})"},
      {is_signed, R"({"bt2": {"children": ["#0", "#1"], "r1": 0.5, "r2": 1, "p": 0.125, "m1": 1, "m2": 0.5}})"},
      {is_signed, R"({"btk": {"children": ["#0", "#1"], "ranges": [0.5, 1], "powers": [2, 3], "weights": [1, 0.5]}})"},
      {is_signed, R"({"smooth_min": {"children": ["#0", "#1"], "radius": 0.5}})"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.node);
    const std::string above = c.leaf == positive ? R"({"ricci": {"children": ["#2", "#3"], "exponent": 2}})"
                                                 : R"({"smooth_min": {"children": ["#2", "#3"], "radius": 0.25}})";
    const std::string leaf = c.leaf;
    v1::Scene scene = scene_of_nodes(leaf + ", " + leaf + ", " + c.node + ", " + leaf + ", " + above);
    const Tape before = tape_of(scene);
    const ParameterBuffers buffers = lay_out(before);
    const Operation& operation = operation_of_node(before, 2);
    int numbers = 0;
    for_each_number(kind_of(*scene.mutable_nodes(2)), [&](const auto& change) {
      v1::Scene edited = scene;
      change(kind_of(*edited.mutable_nodes(2)));
      const ParameterBuffers moved = lay_out(tape_of(edited));
      expect_change_within(buffers.operations, moved.operations, operation.begin(),
                           operation.begin() + operation_record_size(operation));
      EXPECT_TRUE(same_bytes(buffers.leaves, moved.leaves));
      EXPECT_TRUE(same_bytes(buffers.tables, moved.tables));
      ++numbers;
    });
    EXPECT_GE(numbers, 1);
  }
}

TEST(ParameterLayout, ConversionsAndFramesAreWrittenAsTheShadersReadThem) {
  const Tape converted = tape_of(scene_of_nodes(R"({"sphere": {"radius": 1, "law": "SIGNED"}},
      {"soften": {"child": "#0", "range": 0.25}}, {"harden": {"child": "#1"}})"));
  const ParameterBuffers conversions = lay_out(converted);
  // The factor of the distance in a positive field's argument, and the factor and offset of 0.5 - f.
  EXPECT_EQ(conversions.operations.at(operation_of_node(converted, 1).record),
            (Float4{static_cast<float>((1 - kR0) / 0.25), 0, 0, 0}));
  EXPECT_EQ(conversions.operations.at(operation_of_node(converted, 2).record), (Float4{-1, 0.5f, 0, 0}));

  // An operator that follows an angle below a transform that is no similarity. Its frame lies before its record.
  const Tape framed = tape_of(scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}},
      {"sphere": {"center": [0.5, 0, 0], "radius": 0.5, "range": 0.5}},
      {"gradient": {"children": ["#0", "#1"]}}, {"transform": {"child": "#2", "scale": [1, 2, 3]}})"));
  const Operation& gradient = operation_of_node(framed, 2);
  ASSERT_TRUE(gradient.frame);
  const Affine::LowerTriangle& l = *gradient.frame;
  const std::vector<Float4> operations = lay_out(framed).operations;
  EXPECT_EQ(operations.at(gradient.record - 2), (Float4{f32(l[0]), f32(l[1]), f32(l[2]), f32(l[3])}));
  EXPECT_EQ(operations.at(gradient.record - 1), (Float4{f32(l[4]), f32(l[5]), 0, 0}));
}

TEST(ParameterLayout, OperatorsShareTablesUntilTheyDiffer) {
  v1::Scene scene =
      scene_of_nodes(R"({"sphere": {"radius": 0.5, "range": 0.5}}, {"sphere": {"radius": 1, "range": 0.5}},
      {"sphere": {"radius": 2, "range": 0.5}}, {"gradient": {"children": ["#0", "#1"]}},
      {"gradient": {"children": ["#3", "#2"]}})");
  const Tape before = tape_of(scene);
  const ParameterBuffers buffers = lay_out(before);
  ASSERT_EQ(before.operations.size(), 2u);
  const Operation& last = before.operations.back();
  scene.mutable_nodes(static_cast<int>(last.node))
      ->mutable_gradient()
      ->mutable_opening()
      ->set_preset(v1::Opening::ORGANIC);
  const ParameterBuffers edited = lay_out(tape_of(scene));
  expect_change_within(buffers.operations, edited.operations, last.begin(), last.begin() + operation_record_size(last));
  ASSERT_GT(edited.tables.size(), buffers.tables.size());
  EXPECT_EQ(std::memcmp(edited.tables.data(), buffers.tables.data(), buffers.tables.size() * sizeof(Float4)), 0)
      << "the first one's stay";
}

TEST(ParameterLayout, RecordsFillTheBuffersAndNoneIsEmpty) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Tape tape = tape_of(test_support::random_scene(seed, {.nodes = 1 + static_cast<int>(seed)}));
    const ParameterBuffers all = lay_out(tape), operations = lay_out_operations(tape);
    EXPECT_TRUE(operations.leaves.empty());
    EXPECT_TRUE(same_bytes(operations.operations, all.operations));
    EXPECT_TRUE(same_bytes(operations.tables, all.tables));
    EXPECT_GE(all.tables.size(), 1u);
    std::vector<int> leaf_owners(all.leaves.size()), owners(all.operations.size());
    for (const Leaf& leaf : tape.leaves) {
      const std::uint32_t size = record_size(leaf.operand);
      std::vector<Float4> record(size);
      write_leaf(leaf, record.data());
      for (std::uint32_t i = 0; i < size; ++i) {
        ++leaf_owners.at(leaf.record + i);
        EXPECT_EQ(std::memcmp(&record[i], &all.leaves[leaf.record + i], sizeof(Float4)), 0) << "leaf " << leaf.node;
      }
    }
    for (const Operation& o : tape.operations) {
      for (std::uint32_t i = 0; i < operation_record_size(o); ++i) ++owners.at(o.begin() + i);
    }
    // A buffer without records has one vec4, for the device to bind to.
    EXPECT_EQ(leaf_owners, std::vector<int>(leaf_owners.size(), tape.leaves.empty() ? 0 : 1));
    EXPECT_EQ(owners, std::vector<int>(owners.size(), tape.operations.empty() ? 0 : 1));
    EXPECT_GE(owners.size(), 1u);
  }
}

}  // namespace
}  // namespace isofield::blobtree
