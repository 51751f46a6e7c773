// Compares operators as volumes on the device with exact arithmetic (nodes, look-ups, [G] Fig. 11), and tests the
// cache.
#include "operators/volume.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <thread>

#include "engine/residency/volume_cache.h"
#include "engine/session.h"
#include "gpu/gpu_environment.h"
#include "operators/gradient_blend.h"
#include "support/random_scene.h"
#include "support/shared_files.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using Float4 = std::array<float, 4>;
using engine::VolumeCache;
using engine::VolumeLease;
using operators::Blend;
using operators::Continuation;
using operators::Silhouette;

constexpr double kQuarterPi = std::numbers::pi / 4;

operators::Operator gradient(int size, const Silhouette& silhouette = {}) {
  return operators::Gradient{.silhouette = silhouette, .volume = size};
}

operators::Operator sampled(int size, const std::function<double(double, double, double)>& function) {
  auto samples = std::make_shared<operators::SampledVolume>();
  samples->size = size;
  for (int k = 0; k < size; ++k) {
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const double last = size - 1;
        samples->values.push_back(static_cast<float>(function(i / last, j / last, k / last * kQuarterPi)));
      }
    }
  }
  return operators::Sampled{.samples = std::move(samples)};
}

VolumeLease get(VolumeCache& cache, const operators::Operator& op) {
  auto volume = cache.get(op);
  EXPECT_TRUE(volume.ok()) << volume.status();
  return volume.ok() ? *volume : nullptr;
}

std::vector<Float4> nodes_of(const engine::Volume& volume) {
  std::vector<Float4> nodes(volume.bytes() / sizeof(Float4));
  auto session = engine::Session::begin(device());
  EXPECT_TRUE(session.ok());
  EXPECT_TRUE(session->download(volume.buffer(), std::span(nodes)).ok());
  EXPECT_TRUE(session->run().ok());
  return nodes;
}

// Runs shaders/operator_volume_probe.comp on rows of f1, f2, t. Without a volume it evaluates the exact smooth blend.
// Partials are with respect to t.
std::vector<Blend> look_up(const std::vector<Float4>& arguments, const engine::Volume* volume,
                           Continuation continuation = Continuation::kAboutBoundary, std::uint32_t slot = 0,
                           std::uint32_t volume_set = 1) {
  std::vector<std::array<Float4, 3>> rows(arguments.size());
  auto session = engine::Session::begin(device());
  EXPECT_TRUE(session.ok());
  const auto argument_buffer = session->upload(std::span(arguments));
  const auto result_buffer = session->scratch(sizeof(rows[0]) * rows.size());
  const auto kernel =
      kernels().get(volume ? shaders::kOperatorVolumeProbe : shaders::kOperatorBlendProbe, {.volume_set = volume_set});
  EXPECT_TRUE(kernel.ok()) << kernel.status();
  gpu::Commands::Bindings bindings{{4, &*argument_buffer}, {5, &*result_buffer}};
  if (volume) bindings.push_back({12 + slot, &volume->buffer()});
  const std::array<std::uint32_t, 4> constants{static_cast<std::uint32_t>(arguments.size()), slot,
                                               static_cast<std::uint32_t>(volume ? volume->size() : 0),
                                               continuation == Continuation::kAboutOrigin};
  EXPECT_TRUE(session->commands()
                  .dispatch(*kernel, bindings, constants, static_cast<std::uint32_t>((arguments.size() + 63) / 64))
                  .ok());
  EXPECT_TRUE(session->download(*result_buffer, std::span(rows)).ok());
  EXPECT_TRUE(session->run().ok());
  std::vector<Blend> results;
  for (const auto& r : rows) {
    results.push_back({r[0][0], r[0][1], r[0][2], r[0][3], r[1][0], r[1][1], r[1][2], r[2][0], r[2][1]});
  }
  return results;
}

std::vector<Float4> random_arguments(std::size_t count, double top) {
  test_support::Random random(3);
  std::vector<Float4> arguments(count);
  for (Float4& a : arguments) {
    a[0] = static_cast<float>(random.number(0, top));
    a[1] = static_cast<float>(random.number(0, top));
    a[2] = static_cast<float>(std::tan(random.number(0, kQuarterPi)));
  }
  return arguments;
}

double theta_of(const Float4& a) {
  return std::atan(double{a[2]});
}

// Returns the largest error of first partials with respect to f1, f2 and t; `exact` has those by theta.
double partial_error(const Blend& b, const Blend& exact, double t) {
  return std::max({std::abs(b.g1 - exact.g1), std::abs(b.g2 - exact.g2), std::abs(b.gt * (1 + t * t) - exact.gt)});
}
double second_error(const Blend& b, const Blend& exact, double t) {
  return std::max({std::abs(b.g11 - exact.g11), std::abs(b.g12 - exact.g12), std::abs(b.g22 - exact.g22),
                   std::abs(b.g1t * (1 + t * t) - exact.g1t), std::abs(b.g2t * (1 + t * t) - exact.g2t)});
}

void expect_exact_node(const Float4& node, const operators::VolumeNode& exact, bool is_at_fold, double& worst,
                       double& worst_partial) {
  worst = std::max(worst, std::abs(node[0] - exact.g));
  if (is_at_fold) return;
  worst_partial = std::max(
      {worst_partial, std::abs(node[1] - exact.g1), std::abs(node[2] - exact.g2), std::abs(node[3] - exact.gt)});
}

TEST(OperatorVolume, NodesEqualExactArithmetic) {
  test_support::Random random(5);
  VolumeCache cache(device(), kernels());
  for (const Silhouette& silhouette :
       {Silhouette{}, Silhouette{Silhouette::Kind::kBulge, 0.8}, Silhouette{Silhouette::Kind::kBulge, 1}}) {
    const bool has_fold = silhouette.kind == Silhouette::Kind::kBulge;
    for (const int n : {16, 32, 64, 128}) {
      const VolumeLease volume = get(cache, gradient(n, silhouette));
      ASSERT_EQ(volume->size(), n);
      const std::vector<Float4> nodes = nodes_of(*volume);
      const operators::VolumeNodes exact = operators::gradient_nodes(silhouette, n);
      double worst = 0, worst_partial = 0;
      // The test reads all nodes of the smallest volume and some of the others, among them nodes of the layers, rows
      // and faces at the ends.
      for (int at = 0; at < 4096; ++at) {
        int i = at % 16, j = at / 16 % 16, k = at / 256;
        if (n > 16) {
          i = random.integer(0, n - 1), j = random.integer(0, n - 1), k = random.integer(0, n - 1);
          if (at % 8 == 0) k = at % 16 ? n - 1 : 0;
          if (at % 8 == 1) j = i;
          if (at % 8 == 2) i = at % 16 == 2 ? n - 1 : n / 2 - 1;
        }
        const Float4& node = nodes[(static_cast<std::size_t>(k) * n + j) * n + i];
        expect_exact_node(node, exact(i, j, k), has_fold && i == j, worst, worst_partial);
        if (j == 0) {
          ASSERT_EQ(node[0], static_cast<float>(i) / static_cast<float>(n - 1));
        }
      }
      std::cout << n << "^3 nodes, K " << silhouette.k << ": value off by " << worst << ", partials by "
                << worst_partial << "\n";
      EXPECT_LE(worst, 2e-6);
      EXPECT_LE(worst_partial, 1e-4);
    }
  }
}

TEST(OperatorVolume, OutdoesFigure11) {
  struct Row {
    int size;
    double most, mean;  // [G] Fig. 11
  };
  const std::vector<Float4> arguments = random_arguments(400'000, 1);
  const std::vector<Blend> exact = look_up(arguments, nullptr);
  VolumeCache cache(device(), kernels());
  for (const Row& row :
       {Row{16, 5.03e-2, 2.97e-3}, Row{32, 2.90e-2, 1.43e-3}, Row{64, 1.39e-2, 7.32e-4}, Row{128, 6.72e-3, 3.69e-4}}) {
    const VolumeLease volume = get(cache, gradient(row.size));
    const std::vector<Blend> results = look_up(arguments, volume.get());
    double most = 0, sum = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const double error = std::abs(results[i].g - exact[i].g);
      most = std::max(most, error);
      sum += error;
    }
    const double mean = sum / static_cast<double>(results.size());
    std::cout << row.size << "^3: max error " << most << ", mean " << mean << " ([G]: " << row.most << ", " << row.mean
              << ")\n";
    EXPECT_LE(most, row.most / 6);
    EXPECT_LE(mean, row.mean / 4.5);
  }
}

// An operator with a formula; it is homogeneous of degree 1.
Blend analytic(double f1, double f2, double theta) {
  const double length = std::hypot(f1, f2), s = std::sin(theta), c = std::cos(theta);
  const double m = std::max(length, 1e-300);
  return {.g = c * (f1 + f2) + (1 - c) * length - s * f1 * f2 / m,
          .g1 = c + (1 - c) * f1 / m - s * f2 * f2 * f2 / (m * m * m),
          .g2 = c + (1 - c) * f2 / m - s * f1 * f1 * f1 / (m * m * m),
          .gt = -s * (f1 + f2) + s * length - c * f1 * f2 / m};
}

void expect_as_reference(const operators::Operator& op, int size, const operators::VolumeNodes& nodes,
                         Continuation continuation) {
  VolumeCache cache(device(), kernels());
  const VolumeLease volume = get(cache, op);
  std::vector<Float4> arguments = random_arguments(1'000, 2.5);
  for (const Float4& a : {Float4{1, 1, 1}, Float4{1, 1, 0}, Float4{3, 1e-4f, 0.5}, Float4{1e-4f, 3, 0.5}}) {
    arguments.push_back(a);
  }
  const std::vector<Blend> results = look_up(arguments, volume.get(), continuation);
  double worst = 0, worst_partial = 0, worst_second = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Float4& a = arguments[i];
    const Blend exact = operators::volume_blend(a[0], a[1], theta_of(a), size, nodes, continuation);
    worst = std::max(worst, std::abs(results[i].g - exact.g));
    worst_partial = std::max(worst_partial, partial_error(results[i], exact, a[2]));
    // Slopes of the interpolation jump from cell to cell, and a float may lie on the other side.
    const double scale = std::max({a[0], a[1], 1.0f});
    const auto is_near_border = [&](double x) { return std::abs(x - std::round(x)) < 1e-3; };
    if (scale > 1 || is_near_border(a[0] * (size - 1)) || is_near_border(a[1] * (size - 1)) ||
        is_near_border(theta_of(a) / kQuarterPi * (size - 1))) {
      if (continuation == Continuation::kAboutBoundary || scale == 1) continue;
      if (is_near_border(std::min(a[0], a[1]) / scale * (size - 1))) continue;
      if (is_near_border(theta_of(a) / kQuarterPi * (size - 1))) continue;
    }
    worst_second = std::max(worst_second, second_error(results[i], exact, a[2]));
  }
  std::cout << size << "^3 look-up: value off by " << worst << ", partials by " << worst_partial << ", second ones by "
            << worst_second << "\n";
  EXPECT_LE(worst, 3e-6);
  EXPECT_LE(worst_partial, 2e-5);
  EXPECT_LE(worst_second, 1e-3);
}

TEST(OperatorVolume, LooksUpAsTheReferenceDoes) {
  expect_as_reference(gradient(16), 16, operators::gradient_nodes({}, 16), Continuation::kAboutBoundary);
  const operators::Operator op =
      sampled(9, [](double f1, double f2, double theta) { return analytic(f1, f2, theta).g; });
  expect_as_reference(op, 9, operators::sampled_nodes(*op.as<operators::Sampled>()->samples),
                      Continuation::kAboutOrigin);
}

TEST(OperatorVolume, LeavesAFieldAloneWhereTheOtherIsZero) {
  VolumeCache cache(device(), kernels());
  const VolumeLease volume = get(cache, gradient(16));
  test_support::Random random(8);
  std::vector<Float4> arguments;
  for (int i = 0; i < 4'000; ++i) {
    const auto f = static_cast<float>(random.number(0, i % 3 == 0 ? 3 : 1)),
               t = static_cast<float>(random.number(0, 1));
    arguments.push_back(i % 2 ? Float4{f, 0, t} : Float4{0, f, t});
  }
  for (const Continuation c : {Continuation::kAboutBoundary, Continuation::kAboutOrigin}) {
    const std::vector<Blend> results = look_up(arguments, volume.get(), c);
    for (std::size_t i = 0; i < results.size(); ++i) {
      ASSERT_EQ(results[i].g, std::max(arguments[i][0], arguments[i][1]));
      ASSERT_EQ(results[i].g1, arguments[i][0] > 0 || i % 2 ? 1 : 0);
    }
  }
}

TEST(OperatorVolume, GoesOnBeyondOne) {
  VolumeCache cache(device(), kernels());
  const VolumeLease volume = get(cache, gradient(128));
  std::vector<Float4> arguments = random_arguments(4'000, 3);
  std::erase_if(arguments, [](const Float4& a) { return std::max(a[0], a[1]) <= 1; });
  const std::vector<Blend> results = look_up(arguments, volume.get());
  double worst = 0, sum = 0, worst_partial = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Float4& a = arguments[i];
    const Blend exact = operators::gradient_blend(a[0], a[1], theta_of(a), {});
    worst = std::max(worst, std::abs(results[i].g - exact.g));
    sum += std::abs(results[i].g - exact.g);
    // Only wide blends are compared, because narrow ones bend within a cell.
    if (a[2] < 0.8) worst_partial = std::max(worst_partial, partial_error(results[i], exact, a[2]));
  }
  std::cout << results.size() << " pairs beyond 1: max error " << worst << ", mean "
            << sum / static_cast<double>(results.size()) << ", of partials " << worst_partial << "\n";
  EXPECT_LE(worst, 3 * 6.72e-3 / 3.5);
  EXPECT_LE(sum / static_cast<double>(results.size()), 3.69e-4 / 4);
  EXPECT_LE(worst_partial, 0.05);
}

TEST(OperatorVolume, SamplesOfAFormulaFollowIt) {
  VolumeCache cache(device(), kernels());
  const VolumeLease volume =
      get(cache, sampled(65, [](double f1, double f2, double theta) { return analytic(f1, f2, theta).g; }));
  ASSERT_EQ(volume->bytes(), 16u * 65 * 65 * 65);
  const std::vector<Float4> arguments = random_arguments(20'000, 2);
  const std::vector<Blend> results = look_up(arguments, volume.get(), Continuation::kAboutOrigin);
  double worst = 0, worst_partial = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Float4& a = arguments[i];
    // The formula has a corner at the origin, and differences are one-sided at the ends.
    const double m = std::max({a[0], a[1], 1.0f}), least = std::min(a[0], a[1]) / m;
    if (std::max(a[0], a[1]) < 0.2 || least < 0.02) continue;
    const Blend exact = analytic(a[0], a[1], theta_of(a));
    worst = std::max(worst, std::abs(results[i].g - exact.g));
    worst_partial = std::max(worst_partial, partial_error(results[i], exact, a[2]));
  }
  std::cout << "sampled formula: value off by " << worst << ", partials by " << worst_partial << "\n";
  EXPECT_LE(worst, 1e-3);
  EXPECT_LE(worst_partial, 3e-2);
}

TEST(OperatorVolume, ReproducesGoldenBlends) {
  const struct {
    const char* file;
    Silhouette silhouette;
    double error_of_a_cell;  // times the side of a cell
  } cases[] = {{"gradient_smooth.csv", {}, 0.32},
               {"gradient_bulge_0.25.csv", {Silhouette::Kind::kBulge, 0.25}, 0.45},
               {"gradient_bulge_0.8.csv", {Silhouette::Kind::kBulge, 0.8}, 2}};
  VolumeCache cache(device(), kernels());
  for (const auto& c : cases) {
    const auto table = test_support::read_csv(test_support::checkout_file(std::string("tests/golden/") + c.file));
    ASSERT_TRUE(table.ok()) << table.status();
    ASSERT_GE(table->rows.size(), 400u);
    std::vector<Float4> arguments;
    for (const auto& row : table->rows) {
      arguments.push_back(
          {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(std::tan(row[2]))});
    }
    for (const int size : {16, 32, 64, 128}) {
      const VolumeLease volume = get(cache, gradient(size, c.silhouette));
      const std::vector<Blend> results = look_up(arguments, volume.get());
      const operators::VolumeNodes nodes = operators::gradient_nodes(c.silhouette, size);
      double worst = 0, off_reference = 0;
      for (std::size_t i = 0; i < results.size(); ++i) {
        const auto& row = table->rows[i];
        test_support::keep_worst(worst, std::abs(results[i].g - row[3]));
        const Blend interpolated =
            operators::volume_blend(row[0], row[1], row[2], size, nodes, Continuation::kAboutBoundary);
        test_support::keep_worst(off_reference, std::abs(results[i].g - interpolated.g));
      }
      std::cout << c.file << ", " << size << "^3: max error " << worst << ", off interpolation of exact nodes by "
                << off_reference << "\n";
      EXPECT_LE(worst, c.error_of_a_cell / (size - 1));
      EXPECT_LE(off_reference, 3e-6);
    }
  }
}

TEST(OperatorVolume, EverySlotReadsItsOwn) {
  VolumeCache cache(device(), kernels());
  const VolumeLease volume = get(cache, gradient(32));
  const std::vector<Float4> arguments = random_arguments(500, 1.5);
  const std::vector<Blend> expected = look_up(arguments, volume.get());
  for (std::uint32_t slot = 0; slot < 4; ++slot) {
    for (const std::uint32_t set : {1u << slot, 1u << slot | 1u, 0xfu}) {
      const std::vector<Blend> results = look_up(arguments, volume.get(), Continuation::kAboutBoundary, slot, set);
      for (std::size_t i = 0; i < results.size(); ++i) {
        ASSERT_EQ(results[i].g, expected[i].g) << slot << " of " << set;
        ASSERT_EQ(results[i].gt, expected[i].gt) << slot << " of " << set;
      }
    }
  }
}

TEST(VolumeCache, SharesFreesAndCounts) {
  const std::uint64_t before = device().allocated_bytes();
  VolumeCache cache(device(), kernels());
  EXPECT_EQ(cache.usage().volumes, 0u);
  VolumeLease a = get(cache, gradient(32));
  const operators::Operator other_opening(operators::Gradient{.opening = operators::organic(), .volume = 32},
                                          operators::Form::kDifference);
  VolumeLease b = get(cache, other_opening);
  EXPECT_EQ(a, b) << "the opening and the form are no part of a volume";
  const VolumeLease larger = get(cache, gradient(64)),
                    bulge = get(cache, gradient(32, {Silhouette::Kind::kBulge, 0.5}));
  EXPECT_NE(a, larger);
  EXPECT_NE(a, bulge);
  EXPECT_EQ(a->bytes(), 16u * 32 * 32 * 32);
  EXPECT_EQ(cache.usage().volumes, 3u);
  EXPECT_EQ(cache.usage().bytes, a->bytes() + larger->bytes() + bulge->bytes());
  EXPECT_EQ(device().allocated_bytes() - before, cache.usage().bytes) << "what it was built from is gone";

  a.reset();
  EXPECT_EQ(cache.usage().volumes, 3u);
  b.reset();
  EXPECT_EQ(cache.usage().volumes, 2u) << "the last lease frees it";
  EXPECT_EQ(device().allocated_bytes() - before, cache.usage().bytes);
  EXPECT_TRUE(get(cache, gradient(32)));
  EXPECT_EQ(cache.usage().volumes, 2u);
}

TEST(VolumeCache, SharesSamplesByContent) {
  const auto formula = [](double f1, double f2, double theta) { return analytic(f1, f2, theta).g; };
  VolumeCache cache(device(), kernels());
  const VolumeLease a = get(cache, sampled(8, formula));
  EXPECT_EQ(a, get(cache, sampled(8, formula)));
  EXPECT_NE(a, get(cache, sampled(9, formula)));
  EXPECT_NE(a, get(cache, sampled(8, [](double f1, double f2, double) { return f1 + f2; })));
  EXPECT_EQ(cache.usage().volumes, 1u);
}

TEST(VolumeCache, BuildsOnceForThreadsThatWantTheSame) {
  const std::uint64_t before = device().allocated_bytes();
  VolumeCache cache(device(), kernels());
  std::array<VolumeLease, 8> leases;
  std::vector<std::thread> threads;
  for (VolumeLease& lease : leases) threads.emplace_back([&] { lease = get(cache, gradient(64)); });
  for (std::thread& t : threads) t.join();
  for (const VolumeLease& lease : leases) EXPECT_EQ(lease, leases[0]);
  EXPECT_EQ(cache.usage().volumes, 1u);
  EXPECT_EQ(device().allocated_bytes() - before, 16u * 64 * 64 * 64);
}

TEST(VolumeCache, RefusesWhatHasNoVolume) {
  VolumeCache cache(device(), kernels());
  EXPECT_EQ(cache.get(gradient(0)).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(cache.get(gradient(48)).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(cache.get(operators::Operator{}).status().code(), absl::StatusCode::kInvalidArgument);
  const operators::Operator whole = sampled(4, [](double, double, double) { return 1.0; });
  auto samples = std::make_shared<operators::SampledVolume>(*whole.as<operators::Sampled>()->samples);
  samples->values.pop_back();
  const operators::Operator broken = operators::Sampled{.samples = samples};
  EXPECT_EQ(cache.get(broken).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(cache.usage().volumes, 0u);
}

}  // namespace
}  // namespace isofield::gpu_test
