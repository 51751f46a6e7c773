// Tests that FieldService answers batches, streams of any length and grids correctly.
#include <gtest/gtest.h>
#include <isofield/client.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "integration/ball.h"
#include "integration/daemon.h"
#include "integration/peer.h"
#include "reference/evaluator.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/smoothness.h"
#include "support/worst.h"

namespace isofield::integration_test {
namespace {

constexpr double kValueError = 2e-5, kGradientError = 1e-3;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Field, BatchesOfAnySizeFollowTheFormula) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  ASSERT_TRUE(ok(peer.put("ball", ball.scene())));
  for (const std::size_t count : {0u, 1u, 2u, 64u, 65'536u, 1u << 20}) {
    const std::vector<float> xyz = points_around(ball, count, count);
    for (const bool gradient : {false, true}) {
      std::vector<float> results;
      ASSERT_TRUE(ok(peer.evaluate(named("ball"), xyz, gradient, &results)));
      ASSERT_EQ(results.size(), count * (gradient ? 4 : 1));
      const Ball::Errors errors = ball.errors(xyz, results);
      EXPECT_LE(errors.value, kValueError);
      EXPECT_LE(errors.gradient, kGradientError);
      std::cout << count << " points: errors " << errors.value << " of values, " << errors.gradient
                << " of gradients\n";
    }
  }
  EXPECT_TRUE(ok(peer.remove("ball")));
}

TEST(Field, DoublesAreRoundedToFloats) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  // Each coordinate lies a quarter or three quarters of the way from one float32 to the next one.
  const std::vector<float> below = points_around(ball, 1, 1000);
  std::vector<double> wide;
  std::vector<float> nearest;
  for (const float x : below) {
    const float above = std::nextafter(x, std::copysign(INFINITY, x));
    const bool is_near = wide.size() % 2 == 0;
    wide.push_back(x + (is_near ? 0.25 : 0.75) * (double{above} - x));
    nearest.push_back(is_near ? x : above);
  }
  v1::EvaluateRequest request;
  *request.mutable_scene() = inlined(ball.scene());
  *request.mutable_points() = points_tensor(std::span(wide));
  v1::EvaluateResponse response;
  ASSERT_TRUE(ok(peer.evaluate(request, &response)));
  std::vector<float> rounded, truncated;
  ASSERT_TRUE(ok(peer.evaluate(inlined(ball.scene()), nearest, false, &rounded)));
  ASSERT_TRUE(ok(peer.evaluate(inlined(ball.scene()), below, false, &truncated)));
  EXPECT_TRUE(same_bits(floats_of(response.result()), rounded)) << "no quantity stated: values";
  EXPECT_FALSE(same_bits(rounded, truncated)) << "these points do not tell rounding from truncation";
}

TEST(Field, TenMillionStreamedPointsFollowTheFormula) {
  constexpr std::uint64_t kPoints = 10'000'000;
  auto client = Client::connect(shared_daemon().address());
  ASSERT_TRUE(client.ok()) << client.status();
  const Ball ball;
  std::uint64_t sent = 0, answered = 0;
  double worst = 0;
  const absl::Status status = client->evaluate(
      inline_scene(ball.scene()), false,
      [&](std::vector<float>& xyz) {
        const std::uint64_t count = std::min<std::uint64_t>(Client::kChunkPoints, kPoints - sent);
        xyz = points_around(ball, sent, count);
        sent += count;
        return absl::OkStatus();
      },
      [&](std::span<const float> xyz, std::span<const float> results) {
        if (const double error = ball.errors(xyz, results).value; !(error <= worst)) worst = error;
        answered += results.size();
        return absl::OkStatus();
      });
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_EQ(answered, kPoints);
  EXPECT_LE(worst, kValueError);
  std::cout << answered << " streamed points: error " << worst << "\n";
}

TEST(Field, StreamsAnswerEveryMessageWithPointsInOrder) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  std::vector<v1::EvaluateStreamRequest> requests(1);
  *requests[0].mutable_scene() = inlined(ball.scene());
  requests[0].set_quantity(v1::VALUE_AND_GRADIENT);
  std::vector<std::vector<float>> sent;
  for (const std::size_t count : {3u, 0u, 70'000u, 1u}) {
    sent.push_back(points_around(ball, count, count));
    *requests.emplace_back().mutable_points() = points_tensor(std::span<const float>(sent.back()));
    requests.emplace_back();  // an empty message has no answer
  }
  std::vector<v1::EvaluateResponse> responses;
  ASSERT_TRUE(ok(peer.evaluate_stream(requests, &responses)));
  ASSERT_EQ(responses.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(responses[i].result().shape(0), sent[i].size() / 3);
    const Ball::Errors errors = ball.errors(sent[i], floats_of(responses[i].result()));
    EXPECT_LE(errors.value, kValueError);
    EXPECT_LE(errors.gradient, kGradientError);
  }
}

TEST(Field, BlendsFollowTheReferenceHoweverTheyAreAsked) {
  auto client = Client::connect(shared_daemon().address());
  ASSERT_TRUE(client.ok());
  Peer peer(shared_daemon().address());
  const v1::Scene scene = test_support::random_scene(77, {.nodes = 60});
  test_support::Random random(5);
  std::vector<float> xyz;
  for (int i = 0; i < 3 * 65'536; ++i) xyz.push_back(static_cast<float>(random.number(-2.5, 2.5)));
  // The points go in one message by the stubs, and streamed by the client.
  std::vector<float> results;
  ASSERT_TRUE(ok(peer.evaluate(inlined(scene), xyz, true, &results)));
  const auto streamed = client->evaluate(inline_scene(scene), xyz, true);
  ASSERT_TRUE(streamed.ok()) << streamed.status();
  EXPECT_TRUE(same_bits(*streamed, results));

  const reference::Evaluator exact(test_support::read_or_die(scene));
  double worst_value = 0, worst_gradient = 0;
  int smooth = 0;
  constexpr std::size_t kStep = 32;
  for (std::size_t i = 0; i < xyz.size() / 3; i += kStep) {
    const blobtree::dvec3 p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    const reference::Sample s = exact.evaluate(p);
    test_support::keep_worst(worst_value, std::abs(results[4 * i] - s.value));
    const double scale = std::max(length(s.gradient), 0.05);
    if (test_support::gradient_variation(exact, p, 2e-6) > 5e-4 * scale) continue;
    ++smooth;
    const blobtree::dvec3 g{results[4 * i + 1], results[4 * i + 2], results[4 * i + 3]};
    test_support::keep_worst(worst_gradient, length(g - s.gradient) / scale);
  }
  EXPECT_LE(worst_value, kValueError);
  EXPECT_LE(worst_gradient, kGradientError);
  EXPECT_GT(smooth, 1800);
  std::cout << xyz.size() / 3 / kStep << " points of a blend: errors " << worst_value << " of values, "
            << worst_gradient << " of gradients\n";
}

TEST(Field, GridsAreTheSameAsTheirPoints) {
  Peer peer(shared_daemon().address());
  const v1::Scene scene = test_support::random_scene(8, {.nodes = 60});
  // The grid has several slabs, and its numbers are exact in float32.
  const std::array<std::uint64_t, 3> counts{130, 121, 50};
  const std::array<float, 3> origin{-2.125f, -1.875f, -2.25f}, spacing{0.03125f, 0.03125f, 0.09375f};
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = inlined(scene);
  std::vector<float> xyz;
  for (int a = 0; a < 3; ++a) {
    request.add_origin(origin[a]);
    request.add_spacing(spacing[a]);
    request.add_counts(counts[a]);
  }
  for (std::uint64_t k = 0; k < counts[2]; ++k) {
    for (std::uint64_t j = 0; j < counts[1]; ++j) {
      for (std::uint64_t i = 0; i < counts[0]; ++i) {
        xyz.insert(xyz.end(),
                   {origin[0] + spacing[0] * static_cast<float>(i), origin[1] + spacing[1] * static_cast<float>(j),
                    origin[2] + spacing[2] * static_cast<float>(k)});
      }
    }
  }
  for (const bool gradient : {false, true}) {
    request.set_quantity(gradient ? v1::VALUE_AND_GRADIENT : v1::VALUE);
    std::vector<float> grid, points;
    std::size_t messages = 0;
    ASSERT_TRUE(ok(peer.evaluate_grid(request, &grid, &messages)));
    ASSERT_TRUE(ok(peer.evaluate(inlined(scene), xyz, gradient, &points)));
    EXPECT_GE(messages, 3u);
    EXPECT_TRUE(same_bits(grid, points));
  }
}

TEST(Field, GridsTakeOneSpacingForAllAxes) {
  Peer peer(shared_daemon().address());
  const Ball ball;
  v1::EvaluateGridRequest request;
  *request.mutable_scene() = inlined(ball.scene());
  for (const double x : {-1.5, -2.0, -1.0}) request.add_origin(x);
  request.add_spacing(0.25);
  std::vector<float> xyz, grid;
  for (const std::uint64_t count : {7, 5, 3}) request.add_counts(count);
  for (int i = 0; i < 105; ++i) {
    xyz.insert(xyz.end(), {-1.5f + 0.25f * static_cast<float>(i % 7), -2 + 0.25f * static_cast<float>(i / 7 % 5),
                           -1 + 0.25f * static_cast<float>(i / 35)});
  }
  ASSERT_TRUE(ok(peer.evaluate_grid(request, &grid)));
  ASSERT_EQ(grid.size(), 105u);
  EXPECT_LE(ball.errors(xyz, grid).value, kValueError);
}

TEST(Field, NoMessageOfAGridIsLargerThanAClientTakes) {
  auto client = Client::connect(shared_daemon().address());
  ASSERT_TRUE(client.ok());
  const Ball ball;
  // Each layer has as many points as one message may hold.
  const auto grid = client->evaluate_grid(inline_scene(ball.scene()), {-1.5, -2, -0.875},
                                          {0.0029296875, 0.0029296875, 0.5}, {1024, 1024, 5}, true);
  ASSERT_TRUE(grid.ok()) << grid.status();
  EXPECT_EQ(grid->values.size(), 1024u * 1024 * 5 * 4);
}

TEST(Field, ResultsAreTheSameBitsEveryTime) {
  Peer peer(shared_daemon().address());
  const v1::Scene scene = test_support::random_scene(9, {.nodes = 100});
  const std::vector<float> xyz = points_around(Ball(), 2, 20'000);
  std::vector<float> first, second;
  ASSERT_TRUE(ok(peer.evaluate(inlined(scene), xyz, true, &first)));
  ASSERT_TRUE(ok(peer.evaluate(inlined(scene), xyz, true, &second)));
  EXPECT_TRUE(same_bits(first, second));
}

}  // namespace
}  // namespace isofield::integration_test
