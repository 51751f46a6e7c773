// Compares fields of random scenes on the device with the reference.
#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "blobtree/scene/parameter_edit.h"
#include "blobtree/tape/blend_edit.h"
#include "engine/points/evaluation_queue.h"
#include "engine/points/field_evaluator.h"
#include "gpu/gpu_environment.h"
#include "reference/evaluator.h"
#include "support/primitive_nodes.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using blobtree::dvec3;
using engine::ResultLayout;

engine::FieldEvaluator& fields() {
  static engine::FieldEvaluator evaluator(device(), kernels(), workers());
  return evaluator;
}

std::vector<float> random_points(std::uint64_t seed, int count, double reach = 2.5) {
  test_support::Random random(seed);
  std::vector<float> xyz;
  for (int i = 0; i < 3 * count; ++i) xyz.push_back(static_cast<float>(random.number(-reach, reach)));
  return xyz;
}

std::vector<float> evaluate(const engine::ResidentScene& scene, const std::vector<float>& xyz, ResultLayout layout) {
  std::vector<float> out(xyz.size() / 3 * layout.numbers(), -1);
  const absl::Status status = fields().evaluate(scene, xyz, layout, out);
  EXPECT_TRUE(status.ok()) << status;
  return out;
}

TEST(FieldOnDevice, AgreesWithTheReferenceOnRandomScenes) {
  double worst_value = 0, worst_gradient = 0;
  int smooth = 0, points = 0;
  // Every scene has kernels of its own, and compiling them takes most of the time.
  const std::uint64_t seeds = scene_count(6);
  for (const int nodes : {1, 2, 3, 5, 10, 20, 40, 80, 120, 200}) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const v1::Scene message = test_support::random_scene(1000 * nodes + seed, {.nodes = nodes});
      const engine::SceneLease scene = resident(message);
      const reference::Evaluator exact(test_support::read_or_die(message));
      const std::vector<float> xyz = random_points(seed + 17, 400);
      const std::vector<float> values = evaluate(*scene, xyz, ResultLayout::kValue);
      const std::vector<float> both = evaluate(*scene, xyz, ResultLayout::kValueAndGradient);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const dvec3 p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
        const reference::Sample s = exact.evaluate(p);
        ++points;
        worst_value = std::max({worst_value, std::abs(values[i] - s.value), std::abs(both[4 * i] - s.value)});
        ASSERT_NEAR(values[i], s.value, 2e-6) << nodes << " nodes, seed " << seed << ", point " << i;
        ASSERT_NEAR(both[4 * i], s.value, 2e-6) << nodes << " nodes, seed " << seed << ", point " << i;
        const dvec3 g{both[4 * i + 1], both[4 * i + 2], both[4 * i + 3]};
        ASSERT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.z));
        // A point is smooth if a move by more than float32's rounding changes the gradient by less than half of the
        // tolerance.
        const double scale = std::max(length(s.gradient), 0.05);
        if (test_support::gradient_variation(exact, p, 2e-6) > 1e-4 * scale) continue;
        ++smooth;
        const double error = length(g - s.gradient) / scale;
        worst_gradient = std::max(worst_gradient, error);
        ASSERT_LE(error, 2e-4) << nodes << " nodes, seed " << seed << ", point " << i << " at " << p.x << " " << p.y
                               << " " << p.z << ": " << g.x << " " << g.y << " " << g.z << ", exact " << s.gradient.x
                               << " " << s.gradient.y << " " << s.gradient.z;
      }
    }
  }
  std::cout << points << " points: max error of values " << worst_value << "; " << smooth
            << " smooth ones: max relative error of gradients " << worst_gradient << "\n";
  EXPECT_GT(smooth, points * 9 / 10);
}

// One kernel blends all kinds of primitives, for drivers that compile slowly.
TEST(FieldOnDevice, AgreesWithTheReferenceOnEveryPrimitive) {
  std::string nodes;
  std::vector<std::string> round, straight{"\"squeezed\""};
  for (const test_support::PrimitiveNode& primitive : test_support::primitive_nodes()) {
    absl::StrAppend(&nodes, primitive.text(primitive.kind, false), ",\n");
    (round.size() <= straight.size() ? round : straight).push_back(absl::StrCat("\"", primitive.kind, "\""));
  }
  const v1::Scene message = test_support::scene_of_nodes(
      absl::StrCat("[", nodes, R"({"name": "squeezed", "transform": {"child": "segment", "scale": [0.7, 1, 1.4]}},
      {"name": "round", "gradient": {"children": [)",
                   absl::StrJoin(round, ", "), R"(]}}, {"name": "straight", "sum": {"children": [)",
                   absl::StrJoin(straight, ", "), R"(]}}, {"gradient": {"children": ["round", "straight"]}}])"));
  const engine::SceneLease scene = resident(message);
  const reference::Evaluator exact(test_support::read_or_die(message));
  const std::vector<float> xyz = random_points(41, 3000, 1.5);
  const std::vector<float> values = evaluate(*scene, xyz, ResultLayout::kValue);
  const std::vector<float> both = evaluate(*scene, xyz, ResultLayout::kValueAndGradient);
  double worst_value = 0, worst_gradient = 0;
  int smooth = 0, alive = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const dvec3 p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    const reference::Sample s = exact.evaluate(p);
    alive += s.value > 0;
    test_support::keep_worst(worst_value, std::abs(values[i] - s.value));
    test_support::keep_worst(worst_value, std::abs(both[4 * i] - s.value));
    const double scale = std::max(length(s.gradient), 0.05);
    if (test_support::gradient_variation(exact, p, 2e-6) > 1e-4 * scale) continue;
    ++smooth;
    const dvec3 g{both[4 * i + 1], both[4 * i + 2], both[4 * i + 3]};
    test_support::keep_worst(worst_gradient, length(g - s.gradient) / scale);
  }
  std::cout << "every primitive: values off by " << worst_value << ", gradients by " << worst_gradient << " of them at "
            << smooth << " smooth points\n";
  EXPECT_GT(alive, 1000);
  EXPECT_GT(smooth, 2500);
  EXPECT_LE(worst_value, 2e-6);
  EXPECT_LE(worst_gradient, 2e-4);
}

TEST(FieldOnDevice, GivesTheSameBitsWhateverTheBatch) {
  const engine::SceneLease scene = resident(test_support::random_scene(5, {.nodes = 120}));
  const std::vector<float> xyz = random_points(3, 5000);
  const std::vector<float> all = evaluate(*scene, xyz, ResultLayout::kValueAndGradient);
  for (const std::size_t first : {0u, 1u, 777u, 4990u}) {
    const std::size_t count = std::min<std::size_t>(10, 5000 - first);
    const std::vector<float> part(xyz.begin() + 3 * first, xyz.begin() + 3 * (first + count));
    const std::vector<float> some = evaluate(*scene, part, ResultLayout::kValueAndGradient);
    EXPECT_EQ(std::memcmp(some.data(), all.data() + 4 * first, some.size() * sizeof(float)), 0);
  }
}

TEST(FieldOnDevice, GivesTheSameBitsOnALatticeAsAtItsPoints) {
  const engine::SceneLease scene = resident(test_support::random_scene(8, {.nodes = 60}));
  // The lattice is exact in float32, whether or not a driver fuses origin + spacing * i.
  const blobtree::Lattice lattice{{-2.125, -1.875, -2.25}, {0.15625, 0.140625, 0.1875}, {27, 30, 22}};
  std::vector<float> xyz;
  for (std::uint32_t k = 0; k < 22; ++k) {
    for (std::uint32_t j = 0; j < 30; ++j) {
      for (std::uint32_t i = 0; i < 27; ++i) {
        xyz.insert(xyz.end(), {-2.125f + 0.15625f * static_cast<float>(i), -1.875f + 0.140625f * static_cast<float>(j),
                               -2.25f + 0.1875f * static_cast<float>(k)});
      }
    }
  }
  for (const ResultLayout layout : {ResultLayout::kValue, ResultLayout::kValueAndGradient}) {
    const std::vector<float> points = evaluate(*scene, xyz, layout);
    std::vector<float> grid(points.size(), -1);
    const std::size_t layer = 27 * 30 * layout.numbers();
    const absl::Status low = fields().evaluate_layers(*scene, lattice, 0, layout, std::span(grid).first(8 * layer));
    const absl::Status high = fields().evaluate_layers(*scene, lattice, 8, layout, std::span(grid).subspan(8 * layer));
    ASSERT_TRUE(low.ok() && high.ok());
    EXPECT_EQ(std::memcmp(grid.data(), points.data(), grid.size() * sizeof(float)), 0);
  }
}

TEST(FieldOnDevice, IsFiniteEverywhere) {
  const engine::SceneLease scene = resident(test_support::random_scene(21, {.nodes = 200}));
  std::vector<float> xyz;
  const float values[] = {0, 1e-38f, -1e-20f, 1, -2, 1e6f, -1e19f, 3.4e38f, -3.4e38f};
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) xyz.insert(xyz.end(), {x, y, z});
    }
  }
  for (const float v : evaluate(*scene, xyz, ResultLayout::kValueAndGradient)) ASSERT_TRUE(std::isfinite(v));
}

TEST(FieldOnDevice, IsFiniteForDegenerateBlends) {
  // The scenes have coincident primitives, opposed gradients, points at centres, and every opening.
  std::string nodes = R"([{"name": "a", "sphere": {"radius": 0.5, "range": 0.5}},
    {"name": "b", "sphere": {"radius": 0.5, "range": 0.5}},
    {"name": "c", "sphere": {"center": [0.5, 0, 0], "radius": 0.2, "range": 2}},
    {"name": "d", "segment": {"a": [-1, 0, 0], "b": [1, 0, 0], "radius_a": 0.3, "radius_b": 0.3, "range": 1}},
    {"name": "e", "sum": {"children": ["a", "b", "c"]}},)";
  for (const char* opening : {R"({"preset": "CAMEL"})", R"({"preset": "ORGANIC"})", R"({"preset": "CONTACT"})"}) {
    for (const char* silhouette : {"{}", R"({"kind": "BULGE", "k": 1})"}) {
      const engine::SceneLease scene = resident(
          test_support::scene_of_nodes(nodes + R"({"gradient": {"children": ["a", "b", "c", "d", "e"], "opening": )" +
                                       opening + R"(, "silhouette": )" + silhouette + "}}]"));
      std::vector<float> xyz = random_points(2, 2000, 1.5);
      for (int i = 0; i < 300; ++i) xyz[3 * i + 1] = xyz[3 * i + 2] = 0;  // on the axes
      xyz[0] = xyz[1] = xyz[2] = 0;
      for (const float v : evaluate(*scene, xyz, ResultLayout::kValueAndGradient)) ASSERT_TRUE(std::isfinite(v));
    }
  }
}

TEST(FieldOnDevice, BlendsThroughVolumesAsTheReferenceDoes) {
  const std::string nodes = R"([
    {"name": "a", "sphere": {"radius": 0.5, "range": 0.5}},
    {"name": "b", "sphere": {"center": [0.6, 0.1, 0], "radius": 0.5, "range": 0.5}},
    {"name": "c", "segment": {"a": [0, -0.6, 0.1], "b": [0, 0.8, 0], "radius_a": 0.3, "radius_b": 0.2, "range": 0.6}},
    {"name": "sum", "sum": {"children": ["a", "b"]}},
    {"name": "joint", "gradient": {"children": ["sum", "c"], "volume": 16}},
    {"name": "cut", "gradient": {"children": ["joint", "b"], "volume": 32, "form": "DIFFERENCE",
             "silhouette": {"kind": "BULGE", "k": 0.5}, "opening": {"preset": "ORGANIC"}}}])";
  const v1::Scene scene = test_support::scene_of_nodes(nodes);
  const reference::Evaluator exact(test_support::read_or_die(scene));
  const engine::SceneLease lease = resident(scene);
  EXPECT_EQ(lease->device_bytes() - lease->own_bytes(), 16u * (16 * 16 * 16 + 32 * 32 * 32));
  const std::vector<float> xyz = random_points(77, 400, 1.0);
  const std::vector<float> results = evaluate(*lease, xyz, ResultLayout::kValueAndGradient);
  int compared = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const blobtree::dvec3 p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    const reference::Sample s = exact.evaluate(p);
    ASSERT_NEAR(results[4 * i], s.value, 2e-5) << i;
    // An interpolated gradient breaks at the faces of cells.
    if (test_support::gradient_variation(exact, p, 2e-6) > 5e-4) continue;
    ++compared;
    const blobtree::dvec3 g{results[4 * i + 1], results[4 * i + 2], results[4 * i + 3]};
    ASSERT_LE(length(g - s.gradient), 2e-3 * std::max(1.0, length(s.gradient))) << i;
  }
  EXPECT_GT(compared, 200);
}

// [G] Figs. 18 and 19 animate an opening. Such an edit must reuse everything else.
TEST(FieldOnDevice, EditedOpeningsShareTheLeaves) {
  v1::Scene scene = test_support::scene_of_nodes(R"([
    {"name": "a", "sphere": {"radius": 0.5, "range": 0.5}},
    {"name": "b", "sphere": {"center": [0.7, 0, 0], "radius": 0.5, "range": 0.5}},
    {"name": "c", "segment": {"a": [0, 0, 0], "b": [0, 1, 0], "radius_a": 0.3, "radius_b": 0.3, "range": 0.6}},
    {"name": "inner", "gradient": {"children": ["a", "b"]}},
    {"name": "outer", "gradient": {"children": ["inner", "c"], "silhouette": {"kind": "BULGE", "k": 0.5}}}])");
  const engine::SceneLease before = resident(scene);
  const std::vector<blobtree::ParameterEdit> edits{{"inner", "opening.theta1", {20}}, {"outer", "silhouette.k", {0.9}}};
  scene.mutable_nodes(3)->mutable_gradient()->mutable_opening()->set_preset(v1::Opening::CAMEL);
  const auto nodes = blobtree::apply_edits(edits, scene);
  ASSERT_TRUE(nodes.ok()) << nodes.status();
  auto tape = blobtree::edit_blends(before->tape(), scene, *nodes, {});
  ASSERT_TRUE(tape.ok() && tape->has_value()) << tape.status();
  const auto after = before->with_operations(device(), **std::move(tape));
  ASSERT_TRUE(after.ok()) << after.status();
  EXPECT_TRUE((*after)->shares_leaves_with(*before));
  // The edited scene gives the same bits as one made from nothing.
  const std::vector<float> xyz = random_points(31, 2000, 1.5);
  const std::vector<float> edited = evaluate(**after, xyz, ResultLayout::kValueAndGradient);
  EXPECT_EQ(edited, evaluate(*resident(scene), xyz, ResultLayout::kValueAndGradient));
  EXPECT_NE(edited, evaluate(*before, xyz, ResultLayout::kValueAndGradient));
  // edit_blends() leaves edits of more than a profile to the compiler, and it refuses wrong values.
  const auto moved = blobtree::apply_edits({{"a", "radius", {0.4}}}, scene);
  EXPECT_FALSE(blobtree::edit_blends((*after)->tape(), scene, *moved, {})->has_value());
  const auto wrong = blobtree::apply_edits({{"inner", "opening.theta1", {46}}}, scene);
  EXPECT_FALSE(blobtree::edit_blends((*after)->tape(), scene, *wrong, {}).ok());
}

TEST(FieldOnDevice, IsZeroWhereNothingIs) {
  for (const int primitives : {20, 1500}) {  // the tape of the latter fits no window
    v1::Scene scene;
    v1::Node sum;
    for (int i = 0; i < primitives; ++i) {
      scene.add_nodes()->mutable_sphere()->set_radius(0.5 + 1e-4 * i);
      scene.mutable_nodes(i)->mutable_sphere()->set_range(0.1);
      sum.mutable_sum()->add_children(test_support::place(i));
    }
    *scene.add_nodes() = sum;
    const engine::SceneLease lease = resident(scene);
    engine::FieldEvaluator fresh(device(), kernels(), workers());
    for (const float near : {5.0f, 0.0f}) {  // all points are far away, or all but some of the first ones
      std::vector<float> xyz = random_points(1, 300'000, 1);
      for (std::size_t i = near == 0 ? 300 : 0; i < xyz.size(); ++i) xyz[i] += 5;
      std::vector<float> out(300'000, 7);
      for (int batch = 0; batch < 3; ++batch) {
        ASSERT_TRUE(fresh.evaluate(*lease, xyz, ResultLayout::kValue, out).ok());
        EXPECT_EQ(std::count_if(out.begin() + 100, out.end(), [](float f) { return f != 0; }), 0);
        EXPECT_EQ(std::count_if(out.begin(), out.begin() + 100, [](float f) { return f != 0; }) > 0, near == 0);
      }
    }
  }
}

// The device keeps the tapes of a scene that is evaluated often.
TEST(FieldOnDevice, GivesTheSameBitsThroughAnIndex) {
  v1::Scene overlapping;  // one piece of it is more than a submission
  v1::Node sum;
  for (int i = 0; i < 40; ++i) {
    overlapping.add_nodes()->mutable_sphere()->set_radius(1 + i * 1e-2);
    overlapping.mutable_nodes(i)->mutable_sphere()->set_range(2);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *overlapping.add_nodes() = sum;
  for (const std::uint64_t seed : {3u, 8u, 21u, 40u}) {
    const engine::SceneLease lease = resident(
        seed == 40 ? overlapping
                   : test_support::random_scene(seed, {.nodes = 80, .cuts = seed == 21, .all_operators = false}));
    ASSERT_GT(lease->tape().code.size(), 12u);
    const std::vector<float> xyz = random_points(seed, 150'000, 2);
    // The evaluator has seen no batch yet, so it sorts the first batches by themselves.
    engine::FieldEvaluator fresh(device(), kernels(), workers());
    std::vector<float> first(4 * 150'000), out(first.size());
    for (int batch = 0; batch < 6; ++batch) {
      std::vector<float>& to = batch == 0 ? first : out;
      const absl::Status s = fresh.evaluate(*lease, xyz, ResultLayout::kValueAndGradient, to);
      ASSERT_TRUE(s.ok()) << s;
      if (batch == 0) continue;
      ASSERT_EQ(std::memcmp(first.data(), out.data(), sizeof(float) * out.size()), 0) << "batch " << batch;
    }
    // Smaller batches give the same bits, whether or not they use the index.
    for (const std::size_t count : {7u, 3000u, 40'000u}) {
      std::vector<float> some(4 * count);
      ASSERT_TRUE(fresh.evaluate(*lease, std::span(xyz).first(3 * count), ResultLayout::kValueAndGradient, some).ok());
      EXPECT_EQ(std::memcmp(first.data(), some.data(), sizeof(float) * some.size()), 0) << count;
    }
  }
}

// The queue runs joined requests in this way: a thread that asks for a turn while it holds one waits for ever.
TEST(FieldOnDevice, AsksForNoTurnBesideTheOneItWasGiven) {
  for (const int nodes : {1, 3, 80}) {
    const engine::SceneLease lease = resident(test_support::random_scene(3, {.nodes = nodes, .all_operators = false}));
    engine::FieldEvaluator fresh(device(), kernels(), workers());
    const std::size_t count = device().profile().joined_points;
    const std::vector<float> xyz = random_points(1, count, 2);
    std::vector<float> out(4 * count);
    for (int batch = 0; batch < 40; ++batch) {  // until an index would be worth its cost
      gpu::Turns::Turn turn = device().turns().take({});
      ASSERT_TRUE(fresh.evaluate(*lease, xyz, ResultLayout::kValueAndGradient, out, {}, {{}, std::move(turn)}).ok());
    }
  }
}

// All primitives overlap, so nothing is culled, and the work comes in pieces between which others can run.
TEST(FieldOnDevice, ALargeBatchIsCutAndCanBeCancelled) {
  v1::Scene scene;
  v1::Node sum;
  for (int i = 0; i < 1000; ++i) {
    v1::Sphere& s = *scene.add_nodes()->mutable_sphere();
    s.set_radius(1);
    s.set_range(1 + i * 1e-3);
    sum.mutable_sum()->add_children(test_support::place(i));
  }
  *scene.add_nodes() = sum;
  const engine::SceneLease lease = resident(scene);
  const std::vector<float> xyz = random_points(5, 40'000, 1);
  std::vector<float> whole(40'000), out(40'000);
  int asked = 0;
  const absl::Status all = fields().evaluate(*lease, xyz, ResultLayout::kValue, whole, [&] { return ++asked < 0; });
  ASSERT_TRUE(all.ok()) << all;
  EXPECT_GE(asked, 4);
  // Small batches give the same bits.
  for (const std::size_t first : {0u, 20'000u, 39'990u}) {
    const std::vector<float> some(xyz.begin() + 3 * first, xyz.begin() + 3 * (first + 10));
    const std::vector<float> part = evaluate(*lease, some, ResultLayout::kValue);
    EXPECT_EQ(std::memcmp(part.data(), &whole[first], 10 * sizeof(float)), 0);
  }
  asked = 0;
  const absl::Status cut = fields().evaluate(*lease, xyz, ResultLayout::kValue, out, [&] { return ++asked == 2; });
  EXPECT_EQ(cut.code(), absl::StatusCode::kCancelled);
  EXPECT_EQ(asked, 2);
}

TEST(FieldOnDevice, TakesDeepTrees) {
  // The tree holds 1,001 spheres, nested 1,000 deep to the left or to the right.
  for (const bool left : {true, false}) {
    v1::Scene scene;
    test_support::Random random(4);
    const auto sphere = [&] {
      auto* s = scene.add_nodes()->mutable_sphere();
      for (int a = 0; a < 3; ++a) s->add_center(random.number(-2, 2));
      s->set_radius(0.1);
      s->set_range(0.3);
      return test_support::place(scene.nodes_size() - 1);
    };
    std::string top = sphere();
    for (int i = 0; i < 1000; ++i) {
      const std::string leaf = sphere();
      auto* blend = scene.add_nodes()->mutable_gradient();
      blend->add_children(left ? top : leaf);
      blend->add_children(left ? leaf : top);
      top = test_support::place(scene.nodes_size() - 1);
    }
    const reference::Evaluator exact(test_support::read_or_die(scene));
    const std::vector<float> xyz = random_points(9, 200, 2);
    const std::vector<float> values = evaluate(*resident(scene), xyz, ResultLayout::kValue);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_NEAR(values[i], exact.value({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}), 2e-5);
    }
  }
}

}  // namespace
}  // namespace isofield::gpu_test
