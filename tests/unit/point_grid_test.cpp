#include "blobtree/cull/point_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

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

// Returns points about the scene's support, some of them as near as possible to the planes between the grid's bricks.
std::vector<float> points_about(const Box& box, Random& random, std::size_t count) {
  std::vector<float> xyz;
  const auto along = [&](double low, double high) {
    const double t = random.chance(0.2) ? random.integer(0, 64) / 64.0 : random.number(-0.1, 1.1);
    xyz.push_back(static_cast<float>(low + t * (high - low)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    along(box.min.x, box.max.x);
    along(box.min.y, box.max.y);
    along(box.min.z, box.max.z);
  }
  return xyz;
}

TEST(PointGrid, SortsEveryPointToATapeThatGivesItsField) {
  int grids = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = read_or_die(test_support::random_scene(seed, {.nodes = 40}));
    const Tape tape = compile_or_die(scene);
    BrickList list;
    const auto grid = PointGrid::make(tape, list, {});
    if (!grid.ok()) {
      EXPECT_EQ(grid.status().code(), absl::StatusCode::kFailedPrecondition) << grid.status();
      continue;
    }
    ++grids;
    const reference::Evaluator evaluator(scene);
    TapeInterpreter interpreter(tape);
    Random random(seed);
    const std::vector<float> xyz = points_about(tape.support, random, 3000);
    const PointGrid::Sorted sorted = grid->sort(xyz);
    ASSERT_EQ(sorted.starts.size(), list.bricks.size() + 2);
    std::vector<int> seen(3000);
    for (std::size_t b = 0; b <= list.bricks.size(); ++b) {
      for (std::uint32_t n = sorted.starts[b]; n < sorted.starts[b + 1]; ++n) {
        const PlacedPoint& p = sorted.points[n];
        ++seen[p.place];
        ASSERT_TRUE(n == sorted.starts[b] || sorted.points[n - 1].place < p.place);
        ASSERT_EQ(std::memcmp(&xyz[3 * p.place], &p, 3 * sizeof(float)), 0);
        const dvec3 at{p.x, p.y, p.z};
        double f = 0;
        if (b < list.bricks.size()) {
          const Brick& brick = list.bricks[b];
          f = interpreter.evaluate({&list.code[brick.tape_begin], brick.tape_count}, at).field.v;
        }
        ASSERT_NEAR(f, evaluator.value(at), 1e-9) << "seed " << seed << ", brick " << b;
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 3000) << "seed " << seed;
  }
  EXPECT_GT(grids, 10);
}

TEST(PointGrid, IsNoneWhereMostPrimitivesOverlap) {
  v1::Scene scene;
  v1::Node sum;
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    v1::Sphere& s = *scene.add_nodes()->mutable_sphere();
    for (int a = 0; a < 3; ++a) s.add_center(random.number(-0.3, 0.3));
    s.set_radius(random.number(0.5, 1));
    s.set_range(0.5);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = sum;
  const Tape tape = compile_or_die(read_or_die(scene));
  BrickList bricks;
  EXPECT_EQ(PointGrid::make(tape, bricks, {}).status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(PointGrid::make(tape, bricks, [] { return true; }).status().code(), absl::StatusCode::kCancelled);
}

// The grid assumes that the field is 0 outside of it.
TEST(PointGrid, IsNoneOfASignedFieldOrOneWithoutAnEnd) {
  v1::Scene spheres;
  v1::Node least, sum;
  for (int i = 0; i < 40; ++i) {
    v1::Sphere& s = *spheres.add_nodes()->mutable_sphere();
    s.add_center(i), s.add_center(0), s.add_center(0);
    s.set_radius(0.4);
    least.mutable_min()->add_children(test_support::place(i));
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  v1::Scene is_signed = spheres, has_no_end = spheres;
  for (v1::Node& node : *is_signed.mutable_nodes()) node.mutable_sphere()->set_law(v1::SIGNED);
  *is_signed.add_nodes() = least;
  for (v1::Node& node : *has_no_end.mutable_nodes()) node.mutable_sphere()->set_range(0.5);
  has_no_end.add_nodes()->mutable_half_space()->set_range(0.5);
  sum.mutable_sum()->add_children(test_support::place(40));
  *has_no_end.add_nodes() = sum;
  for (const v1::Scene& scene : {is_signed, has_no_end}) {
    BrickList bricks;
    const auto grid = PointGrid::make(compile_or_die(read_or_die(scene)), bricks, {});
    EXPECT_EQ(grid.status().code(), absl::StatusCode::kFailedPrecondition) << grid.status();
  }
}

TEST(PointGrid, SortsInPartsAsInOne) {
  const Tape tape = compile_or_die(read_or_die(test_support::random_scene(5, {.nodes = 40})));
  BrickList list;
  const auto grid = PointGrid::make(tape, list, {});
  ASSERT_TRUE(grid.ok()) << grid.status();
  Random random(5);
  for (const std::size_t count : {0u, 1u, 8191u, 20'000u, 100'000u}) {
    const std::vector<float> xyz = points_about(tape.support, random, count);
    std::size_t parts = 0;
    const PointGrid::Sorted whole = grid->sort(xyz);
    const PointGrid::Sorted sorted = grid->sort(xyz, [&](std::size_t n, const std::function<void(std::size_t)>& work) {
      parts = n;
      for (std::size_t i = n; i > 0; --i) work(i - 1);
    });
    EXPECT_EQ(parts > 1, count > 16'000);
    EXPECT_EQ(sorted.starts, whole.starts);
    EXPECT_EQ(sorted.starts.back(), count);
    EXPECT_EQ(std::memcmp(sorted.points.get(), whole.points.get(), count * sizeof(PlacedPoint)), 0);
  }
}

}  // namespace
}  // namespace isofield::blobtree
