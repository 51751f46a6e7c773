#include "blobtree/cull/point_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "blobtree/cull/point_grid.h"
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

dvec3 point_at(const std::vector<float>& xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

// Checks that every point is in exactly one group, whose tape gives its field.
void expect_covers(const Scene& scene, const std::vector<float>& xyz) {
  const Tape tape = compile_or_die(scene);
  const reference::Evaluator evaluator(scene);
  TapeInterpreter interpreter(tape);
  const PointBins bins = bin_points(tape, xyz);
  const std::size_t count = xyz.size() / 3;
  std::vector<int> groups_of(count, 0);
  for (const PointGroup& g : bins.groups) {
    ASSERT_LE(g.first + g.count, count);
    ASSERT_LE(g.tape_begin + g.tape_count, bins.code.size());
    const std::span<const Instruction> code(bins.code.data() + g.tape_begin, g.tape_count);
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i) {
      const std::uint32_t point = bins.points ? bins.points[i].place : i;
      ASSERT_LT(point, count);
      ASSERT_TRUE(!bins.points || std::memcmp(&bins.points[i], &xyz[3 * point], 3 * sizeof(float)) == 0);
      ++groups_of[point];
      if (point % 5 == 0) {
        const dvec3 p = point_at(xyz, point);
        const double f = code.empty() ? 0 : interpreter.evaluate(code, p).field.v;
        ASSERT_NEAR(f, evaluator.value(p), 1e-9);
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(groups_of[i], 1);
}

TEST(PointBins, CoverRandomBatches) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const Scene scene = read_or_die(test_support::random_scene(seed, {.nodes = random.integer(1, 80)}));
    std::vector<float> xyz(3 * static_cast<std::size_t>(random.integer(0, 1500)));
    const double spread = random.chance(0.3) ? 6 : 1.5;
    for (float& x : xyz) x = static_cast<float>(random.number(-spread, spread));
    expect_covers(scene, xyz);
    if (HasFatalFailure()) return;
  }
}

TEST(PointBins, CoverEqualPointsAndPointsOnALine) {
  const Scene scene = read_or_die(test_support::random_scene(7, {.nodes = 80}));
  std::vector<float> same, line, neighbours;
  for (int i = 0; i < 1000; ++i) {
    same.insert(same.end(), {0.25f, -0.5f, 0.125f});
    line.insert(line.end(), {-2 + 0.004f * i, 0.1f, 0.1f});
    // Each coordinate has two values, and no float lies between them.
    for (int bit = 0; bit < 3; ++bit) neighbours.push_back((i >> bit & 1) != 0 ? 0.25f : 0.25f - 0x1p-26f);
  }
  expect_covers(scene, same);
  expect_covers(scene, line);
  expect_covers(scene, neighbours);
}

// Shared memory may hold such numbers even after a check, because the client can change them.
TEST(PointBins, AndPointGridEndWhereNumbersAreNotFinite) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::vector<float>> choices{
      {nan}, {inf}, {-inf}, {inf, -inf}, {nan, 0.5f, -0.5f, 0.1f}, {inf, 0.3f, nan, -0.2f, 3e38f, -3e38f}};
  int grids = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Tape tape = compile_or_die(read_or_die(test_support::random_scene(seed, {.nodes = 80})));
    ASSERT_GT(tape.code.size(), kUnsortedInstructions);
    BrickList list;
    const auto grid = PointGrid::make(tape, list, {});
    Random random(seed);
    for (const std::vector<float>& from : choices) {
      std::vector<float> xyz(3000);
      for (float& x : xyz) x = from[static_cast<std::size_t>(random.integer(0, static_cast<int>(from.size()) - 1))];
      const PointBins bins = bin_points(tape, xyz);
      std::vector<int> seen(1000);
      for (const PointGroup& g : bins.groups) {
        for (std::uint32_t n = g.first; n < g.first + g.count; ++n) ++seen[bins.points[n].place];
      }
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 1000);
      if (!grid.ok()) continue;  // the scene has no end
      ++grids;
      EXPECT_EQ(grid->sort(xyz).starts.back(), 1000u);
    }
  }
  EXPECT_GT(grids, 12);
}

TEST(PointBins, AnEmptyBatchHasNoGroups) {
  const Tape tape = compile_or_die(read_or_die(test_support::random_scene(7)));
  EXPECT_TRUE(bin_points(tape, {}).groups.empty());
}

TEST(PointBins, PointsOfALargeSceneGetShortTapes) {
  // The scene has 20^3 spheres, each of which touches only its neighbours.
  v1::Scene message;
  v1::Node all;
  for (int i = 0; i < 8000; ++i) {
    v1::Sphere& s = *message.add_nodes()->mutable_sphere();
    for (const int x : {i % 20, i / 20 % 20, i / 400}) s.add_center(x);
    s.set_radius(0.3);
    s.set_range(0.3);
    all.mutable_gradient()->add_children(test_support::place(i));
  }
  *message.add_nodes() = all;
  const Tape tape = compile_or_die(read_or_die(message));
  Random random(1);
  std::vector<float> xyz(3 * 20000);
  for (float& x : xyz) x = static_cast<float>(random.number(-0.5, 19.5));
  const PointBins bins = bin_points(tape, xyz);
  double work = 0;
  for (const PointGroup& g : bins.groups) work += static_cast<double>(g.count) * g.tape_count;
  EXPECT_LT(work / 20000, 60);
}

}  // namespace
}  // namespace isofield::blobtree
