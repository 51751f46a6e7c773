// The gradient blend and its opening functions on the device, against golden values and against exact arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "engine/session.h"
#include "gpu/gpu_environment.h"
#include "operators/gradient_blend.h"
#include "operators/profile_table.h"
#include "support/random_scene.h"
#include "support/shared_files.h"

namespace isofield::gpu_test {
namespace {

using Float4 = std::array<float, 4>;
using operators::Silhouette;

enum class Probe : std::uint32_t { kTableBlend = 0, kSmoothBlend = 1, kOpening = 2 };

// Runs shaders/operator_probe.comp.
std::vector<Float4> probe(const std::vector<Float4>& arguments, const operators::ProfileTable& table, Probe kind) {
  std::vector<Float4> results(arguments.size());
  auto session = engine::Session::begin(device());
  EXPECT_TRUE(session.ok());
  const auto table_buffer = session->upload(std::span(table));
  const auto argument_buffer = session->upload(std::span(arguments));
  const auto result_buffer = session->scratch(sizeof(Float4) * arguments.size());
  const auto kernel = kernels().get(shaders::kOperatorProbe);
  EXPECT_TRUE(kernel.ok()) << kernel.status();
  const std::array<std::uint32_t, 2> constants{static_cast<std::uint32_t>(arguments.size()),
                                               static_cast<std::uint32_t>(kind)};
  EXPECT_TRUE(session->commands()
                  .dispatch(**kernel, {{2, &*table_buffer}, {4, &*argument_buffer}, {5, &*result_buffer}}, constants,
                            static_cast<std::uint32_t>((arguments.size() + 63) / 64))
                  .ok());
  EXPECT_TRUE(session->download(*result_buffer, std::span(results)).ok());
  EXPECT_TRUE(session->run().ok());
  return results;
}

// By the polynomial where the silhouette is smooth, else by its table.
std::vector<Float4> probe_blend(const std::vector<Float4>& arguments, const Silhouette& silhouette) {
  return probe(arguments, operators::silhouette_table(silhouette),
               silhouette.kind == Silhouette::Kind::kSmooth ? Probe::kSmoothBlend : Probe::kTableBlend);
}

void expect_golden_blend(const std::string& file, const Silhouette& silhouette, double tolerance) {
  ISOFIELD_NEEDS_SHARED("golden/" + file);
  const auto table = test_support::read_csv(test_support::shared_file("golden/" + file));
  ASSERT_TRUE(table.ok()) << table.status();
  std::vector<Float4> arguments;
  for (const auto& row : table->rows) {
    arguments.push_back({static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(std::tan(row[2]))});
  }
  const std::vector<Float4> results = probe_blend(arguments, silhouette);
  double worst = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    worst = std::max(worst, std::abs(results[i][0] - table->rows[i][3]));
  }
  std::cout << file << ": max error " << worst << "\n";
  EXPECT_GT(results.size(), 400u);
  EXPECT_LE(worst, tolerance);
}

TEST(OperatorOnDevice, ReproducesGoldenSmoothBlend) {
  expect_golden_blend("gradient_smooth.csv", {}, 2e-6);
}
TEST(OperatorOnDevice, ReproducesGoldenBulges) {
  expect_golden_blend("gradient_bulge_0.8.csv", {Silhouette::Kind::kBulge, 0.8}, 2e-6);
  expect_golden_blend("gradient_bulge_0.25.csv", {Silhouette::Kind::kBulge, 0.25}, 2e-6);
}

TEST(OperatorOnDevice, ReproducesGoldenOpenings) {
  const std::pair<const char*, operators::Opening> openings[] = {
      {"camel", operators::camel()}, {"organic", operators::organic()}, {"contact", operators::contact()}};
  for (const auto& [name, opening] : openings) {
    const std::string file = std::string("golden/opening_") + name + ".csv";
    ISOFIELD_NEEDS_SHARED(file);
    const auto table = test_support::read_csv(test_support::shared_file(file));
    ASSERT_TRUE(table.ok()) << table.status();
    std::vector<Float4> arguments;
    for (const auto& row : table->rows) arguments.push_back({static_cast<float>(row[0])});
    const std::vector<Float4> results = probe(arguments, operators::opening_table(opening), Probe::kOpening);
    double worst = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      worst = std::max(worst, std::abs(std::atan(double{results[i][0]}) - table->rows[i][1]));
    }
    std::cout << file << ": max error " << worst << "\n";
    EXPECT_LE(worst, 1e-6) << file;
  }
}

TEST(OperatorOnDevice, LeavesAFieldAloneWhereTheOtherIsZero) {
  test_support::Random random(7);
  std::vector<Float4> arguments;
  for (int i = 0; i < 20'000; ++i) {
    const auto f = static_cast<float>(random.number(0, i % 3 == 0 ? 3 : 1));
    const auto t = static_cast<float>(i % 7 == 0 ? 0 : i % 11 == 0 ? 1 : random.number(0, 1));
    arguments.push_back(i % 2 ? Float4{f, 0, t} : Float4{0, f, t});
  }
  for (const Silhouette& s : {Silhouette{}, Silhouette{Silhouette::Kind::kBulge, 0.8}}) {
    const std::vector<Float4> results = probe_blend(arguments, s);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const float f = std::max(arguments[i][0], arguments[i][1]);
      ASSERT_EQ(results[i][0], f) << "g(" << arguments[i][0] << ", " << arguments[i][1] << ", t = " << arguments[i][2]
                                  << ")";
    }
  }
}

TEST(OperatorOnDevice, AgreesWithExactArithmeticOnRandomInput) {
  test_support::Random random(11);
  std::vector<Float4> arguments;
  for (int i = 0; i < 20'000; ++i) {
    const double top = i % 4 == 0 ? 2 : 1;
    const double f1 = random.number(0, top);
    // Some lie at the fold of a bulge, or nearly so.
    const double f2 = i % 5 == 0 ? f1 * (1 - std::pow(10.0, -random.integer(1, 8))) : random.number(0, top);
    arguments.push_back({static_cast<float>(f1), static_cast<float>(f2), static_cast<float>(random.number(0, 1))});
  }
  std::vector<std::pair<Silhouette, double>> silhouettes{{{}, 2e-6}};
  for (const double k : {0.25, 0.8, 0.9, 0.97, 0.99, 0.999, 1.0}) {
    silhouettes.push_back({{Silhouette::Kind::kBulge, k}, 2e-6});
  }
  for (const auto& [silhouette, tolerance] : silhouettes) {
    const std::vector<Float4> results = probe_blend(arguments, silhouette);
    double worst = 0, worst_partial = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const Float4& a = arguments[i];
      const operators::Blend exact = operators::gradient_blend(a[0], a[1], std::atan(double{a[2]}), silhouette);
      worst = std::max(worst, std::abs(results[i][0] - exact.g));
      // A bulge folds at f1 = f2: its partials jump.
      if (silhouette.kind == Silhouette::Kind::kBulge && std::abs(a[0] - a[1]) < 0.02) continue;
      const double gt = exact.gt / (1 + double{a[2]} * a[2]);
      worst_partial = std::max({worst_partial, std::abs(results[i][1] - exact.g1), std::abs(results[i][2] - exact.g2),
                                std::abs(results[i][3] - gt)});
    }
    std::cout << "random arguments, K " << silhouette.k << ": max error of g " << worst << ", of its partials "
              << worst_partial << "\n";
    EXPECT_LE(worst, tolerance);
    EXPECT_LE(worst_partial, 1e-3);
  }
}

}  // namespace
}  // namespace isofield::gpu_test
