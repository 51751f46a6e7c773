// Compares written kernels (tier two) with the interpreter, and tests for which scenes they are made.
#include "engine/points/written_kernels.h"

#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "blobtree/scene/parameter_edit.h"
#include "blobtree/tape/blend_edit.h"
#include "engine/points/field_evaluator.h"
#include "engine/points/tape_writer.h"
#include "gpu/gpu_environment.h"
#include "gpu/operator_cases.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"

namespace isofield::gpu_test {
namespace {

using engine::ResultLayout;
using engine::WrittenKernels;

std::vector<float> random_points(std::uint64_t seed, int count) {
  test_support::Random random(seed);
  std::vector<float> xyz;
  for (int i = 0; i < 3 * count; ++i) xyz.push_back(static_cast<float>(random.number(-2, 2)));
  return xyz;
}

std::vector<float> evaluate(const engine::ResidentScene& scene, const std::vector<float>& xyz, ResultLayout layout,
                            WrittenKernels* written) {
  engine::FieldEvaluator fields(device(), kernels(), workers(), written);
  std::vector<float> out(xyz.size() / 3 * layout.numbers(), -1);
  const absl::Status status = fields.evaluate(scene, xyz, layout, out);
  EXPECT_TRUE(status.ok()) << status;
  return out;
}

// Makes the scene's kernel. Returns false if the scene gets none.
bool make_hot(WrittenKernels& written, const engine::ResidentScene& scene, bool with_gradient = true) {
  (void)written.find(scene, with_gradient, 1u << 30);
  written.wait();
  return written.find(scene, with_gradient, 0) != nullptr;
}

void expect_near(const std::vector<float>& written, const std::vector<float>& interpreted, std::size_t components,
                 const std::string& what) {
  ASSERT_EQ(written.size(), interpreted.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    same += written[i] == interpreted[i] ? 1 : 0;
    // The bound is the rounding of the point's whole gradient, because its components cancel.
    const float* const whole = &interpreted[i / components * components];
    float scale = 1;
    for (std::size_t c = 0; c < components; ++c) scale = std::max(scale, std::abs(whole[c]));
    ASSERT_NEAR(written[i], interpreted[i], 2e-6f * scale) << what << ", number " << i;
  }
  EXPECT_GE(same, written.size() * 9 / 10) << what;
}

v1::Scene two_spheres(double radius, const std::string& opening = "CAMEL") {
  return test_support::scene_of_nodes(absl::StrCat(R"([{"name": "a", "sphere": {"radius": )", radius,
                                                   R"(, "range": 0.6}},
    {"name": "b", "sphere": {"center": [0.7, 0, 0], "radius": )",
                                                   radius, R"(, "range": 0.5}},
    {"name": "c", "gradient": {"children": ["a", "b"], "opening": {"preset": ")",
                                                   opening, R"("}}}])"));
}

std::filesystem::path only_file(const test_support::TemporaryFolder& folder) {
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  return std::filesystem::directory_iterator(folder.path())->path();
}

TEST(WrittenKernels, AgreeWithTheInterpreterOnRandomScenes) {
  WrittenKernels written(device(), {});
  const std::uint64_t seeds = scene_count(4);
  std::uint64_t made = 0;
  for (const int nodes : {1, 3, 5, 8, 12}) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const engine::SceneLease scene = resident(test_support::random_scene(7000 * nodes + seed, {.nodes = nodes}));
      const std::vector<float> xyz = random_points(seed, 500);
      for (const ResultLayout layout : {ResultLayout::kValue, ResultLayout::kValueAndGradient}) {
        if (!make_hot(written, *scene, layout == ResultLayout::kValueAndGradient)) continue;
        ++made;
        expect_near(evaluate(*scene, xyz, layout, &written), evaluate(*scene, xyz, layout, nullptr), layout.numbers(),
                    absl::StrCat(nodes, " nodes, seed ", seed));
      }
    }
  }
  EXPECT_GE(made, 5 * seeds);
  EXPECT_EQ(written.counts().failures, 0u);
}

TEST(WrittenKernels, AgreeWithTheInterpreterOnEveryOperator) {
  WrittenKernels written(device(), {});
  const std::vector<float> xyz = random_points(2, 1000);
  for (const Case& c : cases()) {
    const bool is_signed = c.op.law() == operators::Law::kSigned;
    std::vector<std::string> names;
    std::string nodes = "[";
    for (std::size_t i = 0; i < c.operands; ++i) {
      names.push_back(absl::StrCat("s", i));
      absl::StrAppend(&nodes, R"({"name": ")", names.back(), R"(", "sphere": {"center": [)",
                      0.4 * static_cast<double>(i), R"(, 0, 0.1], "radius": 0.5, )",
                      is_signed ? R"("law": "SIGNED"}},)" : R"("range": 0.6}},)");
    }
    const engine::SceneLease scene =
        resident(test_support::scene_of_nodes(absl::StrCat(nodes, operator_node(c.op, names), "]")));
    ASSERT_TRUE(make_hot(written, *scene)) << c.name;
    expect_near(evaluate(*scene, xyz, ResultLayout::kValueAndGradient, &written),
                evaluate(*scene, xyz, ResultLayout::kValueAndGradient, nullptr), 4, c.name);
  }
}

TEST(WrittenKernels, AreOfStructuresThatManyPointsAreAskedOf) {
  WrittenKernels written(device(), {.hot_points = 1000});
  const engine::SceneLease scene = resident(two_spheres(0.5));
  EXPECT_EQ(written.find(*scene, true, 999), nullptr);
  written.wait();
  EXPECT_EQ(written.find(*scene, true, 0), nullptr);
  EXPECT_EQ(written.counts().kernels, 0u);
  (void)written.find(*scene, true, 1);
  written.wait();
  EXPECT_NE(written.find(*scene, true, 0), nullptr);
  // The other layout has a kernel of its own.
  EXPECT_EQ(written.find(*scene, false, 0), nullptr);
}

TEST(WrittenKernels, AreSharedByScenesWithOtherParameters) {
  WrittenKernels written(device(), {});
  const engine::SceneLease one = resident(two_spheres(0.5)), other = resident(two_spheres(0.3, "ORGANIC"));
  ASSERT_TRUE(make_hot(written, *one));
  EXPECT_EQ(written.find(*other, true, 0), written.find(*one, true, 0));
  const std::vector<float> xyz = random_points(4, 500);
  const std::vector<float> values = evaluate(*other, xyz, ResultLayout::kValueAndGradient, &written);
  expect_near(values, evaluate(*other, xyz, ResultLayout::kValueAndGradient, nullptr), 4, "other parameters");
  EXPECT_NE(values, evaluate(*one, xyz, ResultLayout::kValueAndGradient, &written));
}

TEST(WrittenKernels, OutliveEditsOfParameters) {
  WrittenKernels written(device(), {});
  v1::Scene scene = two_spheres(0.5);
  const engine::SceneLease before = resident(scene);
  ASSERT_TRUE(make_hot(written, *before));
  const auto nodes = blobtree::apply_edits({{"c", "opening.theta1", {20}}}, scene);
  ASSERT_TRUE(nodes.ok()) << nodes.status();
  auto tape = blobtree::edit_blends(before->tape(), scene, *nodes, {});
  ASSERT_TRUE(tape.ok() && tape->has_value()) << tape.status();
  const auto after = before->with_operations(device(), **std::move(tape));
  ASSERT_TRUE(after.ok()) << after.status();
  EXPECT_EQ(written.find(**after, true, 0), written.find(*before, true, 0));
  const std::vector<float> xyz = random_points(6, 500);
  expect_near(evaluate(**after, xyz, ResultLayout::kValueAndGradient, &written),
              evaluate(**after, xyz, ResultLayout::kValueAndGradient, nullptr), 4, "edited");
}

// The batch needs more than one submission, and the last one is not a whole number of workgroups.
TEST(WrittenKernels, TakeLargeBatches) {
  WrittenKernels written(device(), {});
  const engine::SceneLease scene = resident(two_spheres(0.5));
  ASSERT_TRUE(make_hot(written, *scene));
  constexpr int kCount = 600'003;  // three submissions
  const std::vector<float> xyz = random_points(8, kCount);
  expect_near(evaluate(*scene, xyz, ResultLayout::kValueAndGradient, &written),
              evaluate(*scene, xyz, ResultLayout::kValueAndGradient, nullptr), 4, "large");
  engine::FieldEvaluator fields(device(), kernels(), workers(), &written);
  std::vector<float> out(4 * std::size_t{kCount});
  int asked = 0;
  const absl::Status cut =
      fields.evaluate(*scene, xyz, ResultLayout::kValueAndGradient, out, [&] { return ++asked == 3; });
  EXPECT_EQ(cut.code(), absl::StatusCode::kCancelled);
}

TEST(WrittenKernels, ReadAndWriteWhereverTheArraysLie) {
  const auto scene = resident(two_spheres(0.8));
  WrittenKernels written(device(), {.hot_points = 1});
  ASSERT_TRUE(make_hot(written, *scene));
  constexpr std::size_t kCount = 50'001, kRoom = 8;
  const std::vector<float> xyz = random_points(5, kCount);
  for (WrittenKernels* const kernels_or_none : {&written, static_cast<WrittenKernels*>(nullptr)}) {
    const std::vector<float> expected = evaluate(*scene, xyz, ResultLayout::kValueAndGradient, kernels_or_none);
    EXPECT_EQ(std::count(expected.begin(), expected.end(), -1), 0) << "not written";
    engine::FieldEvaluator fields(device(), kernels(), workers(), kernels_or_none);
    // The numbers are offsets of floats into arrays that lie at multiples of 16 bytes.
    for (const auto& [in, out] : {std::pair{0, 0}, {4, 4}, {1, 4}, {4, 3}, {2, 1}}) {
      std::vector<float> points(in), results(4 * kCount + 2 * kRoom, -7);
      points.insert(points.end(), xyz.begin(), xyz.end());
      const absl::Status s = fields.evaluate(*scene, std::span(points).subspan(in), ResultLayout::kValueAndGradient,
                                             std::span(results).subspan(out, 4 * kCount));
      ASSERT_TRUE(s.ok()) << s;
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), results.begin() + out)) << in << ", " << out;
      EXPECT_EQ(std::count(results.begin(), results.begin() + out, -7), out) << "before the results";
      EXPECT_EQ(std::count(results.begin() + out + 4 * kCount, results.end(), -7), 2 * kRoom - out) << "behind them";
    }
  }
}

TEST(WrittenKernels, NeverOfLongTapesNorWhereTheyAreOff) {
  WrittenKernels written(device(), {}), off(device(), {.is_on = false, .hot_points = 0});
  EXPECT_FALSE(make_hot(off, *resident(two_spheres(0.5))));
  EXPECT_FALSE(make_hot(written, *resident(test_support::random_scene(3, {.nodes = 300}))));
  EXPECT_EQ(written.counts().kernels + written.counts().failures, 0u);
}

TEST(WrittenKernels, AreNeverMoreThanTheMost) {
  constexpr std::uint64_t kMost = 2;
  WrittenKernels written(device(), {.hot_points = 1, .most_kernels = kMost});
  std::vector<engine::SceneLease> scenes;
  std::string nodes;
  for (int i = 0; i < 5; ++i) {
    absl::StrAppend(&nodes, i > 0 ? "," : "", R"({"sphere": {"center": [)", i,
                    R"(, 0, 0], "radius": 0.6, "range": 0.5}})");
    std::string children;
    for (int child = 0; child <= i; ++child) absl::StrAppend(&children, child > 0 ? "," : "", "\"#", child, "\"");
    scenes.push_back(resident(
        test_support::scene_of_nodes(absl::StrCat("[", nodes, R"(, {"sum": {"children": [)", children, "]}}]"))));
  }
  // All of them become hot faster than one kernel is made.
  for (const engine::SceneLease& scene : scenes) {
    (void)written.find(*scene, true, 1);
    EXPECT_LE(written.counts().held, kMost);
  }
  written.wait();
  EXPECT_EQ(written.counts().held, kMost);
  // A structure that found no place gets its kernel in the place of another one.
  for (const engine::SceneLease& scene : scenes) {
    EXPECT_TRUE(make_hot(written, *scene));
    EXPECT_EQ(written.counts().held, kMost);
  }
}

TEST(WrittenKernels, AreKeptOnDisk) {
  const test_support::TemporaryFolder folder;
  const engine::SceneLease scene = resident(two_spheres(0.5));
  const std::vector<float> xyz = random_points(5, 200);
  const std::vector<float> expected = evaluate(*scene, xyz, ResultLayout::kValueAndGradient, nullptr);
  const auto from_disk = [&] {
    WrittenKernels written(device(), {.folder = folder.path()});
    EXPECT_TRUE(make_hot(written, *scene));
    expect_near(evaluate(*scene, xyz, ResultLayout::kValueAndGradient, &written), expected, 4, "kept");
    return written.counts().from_disk;
  };
  EXPECT_EQ(from_disk(), 0u);
  EXPECT_EQ(from_disk(), 1u);
  // The file is cut short, emptied, or has a changed bit. The kernel is then compiled again and written anew.
  const std::filesystem::path file = only_file(folder);
  const auto size = std::filesystem::file_size(file);
  for (const std::uintmax_t bytes : {size / 2, std::uintmax_t{5}, std::uintmax_t{0}}) {
    std::filesystem::resize_file(file, bytes);
    EXPECT_EQ(from_disk(), 0u) << bytes;
    EXPECT_EQ(from_disk(), 1u) << bytes;
  }
  for (const std::uintmax_t at : {std::uintmax_t{3}, std::uintmax_t{40}, size - 7}) {
    {
      std::fstream changed(file, std::ios::binary | std::ios::in | std::ios::out);
      changed.seekg(static_cast<std::streamoff>(at));
      const char byte = static_cast<char>(changed.get() ^ 1);
      changed.seekp(static_cast<std::streamoff>(at));
      changed.put(byte);
    }
    EXPECT_EQ(from_disk(), 0u) << at;
    EXPECT_EQ(from_disk(), 1u) << at;
  }
}

}  // namespace
}  // namespace isofield::gpu_test
