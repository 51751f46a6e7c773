// Compares the gradient blend and its opening functions on the device with golden values and with exact arithmetic.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "blobtree/tape/parameter_layout.h"
#include "engine/points/operator_evaluator.h"
#include "gpu/gpu_environment.h"
#include "operators/gradient_blend.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "support/shared_files.h"
#include "support/worst.h"

namespace isofield::gpu_test {
namespace {

using Float4 = std::array<float, 4>;
using engine::Steering;
using operators::Silhouette;

constexpr float kQuarter = 0.7853981f;  // pi / 4, from below

engine::OperatorEvaluator& evaluator() {
  static engine::OperatorEvaluator evaluator(device(), kernels(), volumes());
  return evaluator;
}

// Returns rows of g and its partials at rows of arguments.
std::vector<float> evaluate(const operators::Operator& op, std::size_t operands, Steering steering,
                            const std::vector<float>& arguments) {
  const std::size_t columns = operands + (steering != Steering::kNone) + op.has_angular_ranges();
  std::vector<float> results(arguments.size() / columns * (1 + operands + (steering != Steering::kNone)));
  const absl::Status status =
      evaluator().evaluate(std::make_shared<const operators::Operator>(op), operands, steering, arguments, results);
  EXPECT_TRUE(status.ok()) << status;
  return results;
}

operators::Operator gradient(const Silhouette& silhouette) {
  return operators::Gradient{.silhouette = silhouette};
}

// Returns g and its derivatives by f1, f2 and theta at each (f1, f2, theta).
std::vector<Float4> probe_blend(const std::vector<Float4>& arguments, const Silhouette& silhouette) {
  std::vector<float> rows;
  for (const Float4& a : arguments) rows.insert(rows.end(), {a[0], a[1], a[2]});
  const std::vector<float> out = evaluate(gradient(silhouette), 2, Steering::kTheta, rows);
  std::vector<Float4> results(arguments.size());
  for (std::size_t i = 0; i < results.size(); ++i) std::copy_n(&out[4 * i], 4, results[i].begin());
  return results;
}

void expect_golden_blend(const std::string& file, const Silhouette& silhouette, double tolerance) {
  const auto table = test_support::read_csv(test_support::checkout_file("tests/golden/" + file));
  ASSERT_TRUE(table.ok()) << table.status();
  std::vector<Float4> arguments;
  for (const auto& row : table->rows) {
    arguments.push_back({static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2])});
  }
  const std::vector<Float4> results = probe_blend(arguments, silhouette);
  double worst = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    test_support::keep_worst(worst, std::abs(results[i][0] - table->rows[i][3]));
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
    const std::string file = std::string("opening_") + name + ".csv";
    const auto table = test_support::read_csv(test_support::checkout_file("tests/golden/" + file));
    ASSERT_TRUE(table.ok()) << table.status();
    ASSERT_GE(table->rows.size(), 400u);
    std::vector<float> alphas;
    for (const auto& row : table->rows) alphas.push_back(static_cast<float>(row[0]));
    std::vector<float> results(2 * alphas.size());
    ASSERT_TRUE(evaluator().evaluate_opening(opening, alphas, results).ok());
    double worst = 0;
    for (std::size_t i = 0; i < alphas.size(); ++i) {
      test_support::keep_worst(worst, std::abs(results[2 * i] - table->rows[i][1]));
    }
    std::cout << file << ": max error " << worst << "\n";
    EXPECT_LE(worst, 1e-6) << file;
  }
}

// [G] stores a blend in a 3-D texture of megabytes.
TEST(OperatorOnDevice, ABlendTakesSixteenKilobytesOfTables) {
  using Kind = Silhouette::Kind;
  for (const auto& [silhouette, bytes] :
       {std::pair{Silhouette{}, 16'400u}, std::pair{Silhouette{Kind::kBulge, 0.8}, 16'400u + 8208u}}) {
    const std::string kind = silhouette.kind == Kind::kBulge ? R"({"kind": "BULGE", "k": 0.8})" : "{}";
    const blobtree::ParameterBuffers parameters =
        blobtree::lay_out(test_support::compile_or_die(test_support::read_or_die(test_support::scene_of_nodes(
            R"([{"name": "a", "sphere": {"radius": 0.5, "range": 0.5}},
                {"name": "b", "sphere": {"center": [1, 0, 0], "radius": 0.5, "range": 0.5}},
                {"gradient": {"children": ["a", "b"], "silhouette": )" +
            kind + "}}]"))));
    const std::size_t tables = parameters.tables.size() * sizeof(parameters.tables[0]);
    std::cout << "tables of one blend: " << tables << " bytes\n";
    EXPECT_LE(tables, bytes);
  }
}

TEST(OperatorOnDevice, AgreesWithExactArithmeticAtTheEndsOfItsDomain) {
  const float fields[] = {0, 1e-30f, 1e-6f, 0.25f, 0.5f, 0.50000006f, 1, 2, 1000};
  std::vector<Float4> arguments;
  for (const float f1 : fields) {
    for (const float f2 : fields) {
      for (const float theta : {0.0f, kQuarter}) arguments.push_back({f1, f2, theta});
    }
  }
  for (const Silhouette& silhouette : {Silhouette{}, Silhouette{Silhouette::Kind::kBulge, 0.8}}) {
    const std::vector<Float4> results = probe_blend(arguments, silhouette);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const Float4& a = arguments[i];
      const operators::Blend exact = operators::gradient_blend(a[0], a[1], a[2], silhouette);
      for (const float r : results[i]) EXPECT_TRUE(std::isfinite(r)) << a[0] << " " << a[1] << " " << a[2];
      EXPECT_NEAR(results[i][0], exact.g, 3e-6 * std::max(1.0, exact.g)) << a[0] << " " << a[1] << " " << a[2];
    }
  }
}

TEST(OperatorOnDevice, LeavesAFieldAloneWhereTheOtherIsZero) {
  test_support::Random random(7);
  std::vector<Float4> arguments;
  for (int i = 0; i < 20'000; ++i) {
    const auto f = static_cast<float>(random.number(0, i % 3 == 0 ? 3 : 1));
    const auto t = i % 7 == 0 ? 0 : i % 11 == 0 ? kQuarter : static_cast<float>(random.number(0, kQuarter));
    arguments.push_back(i % 2 ? Float4{f, 0, t} : Float4{0, f, t});
  }
  for (const Silhouette& s : {Silhouette{}, Silhouette{Silhouette::Kind::kBulge, 0.8}}) {
    const std::vector<Float4> results = probe_blend(arguments, s);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const float f = std::max(arguments[i][0], arguments[i][1]);
      ASSERT_EQ(results[i][0], f) << "g(" << arguments[i][0] << ", " << arguments[i][1]
                                  << ", theta = " << arguments[i][2] << ")";
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
    arguments.push_back(
        {static_cast<float>(f1), static_cast<float>(f2), static_cast<float>(random.number(0, kQuarter))});
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
      const operators::Blend exact = operators::gradient_blend(a[0], a[1], a[2], silhouette);
      test_support::keep_worst(worst, std::abs(results[i][0] - exact.g));
      // A bulge folds at f1 = f2: its partials jump.
      if (silhouette.kind == Silhouette::Kind::kBulge && std::abs(a[0] - a[1]) < 0.02) continue;
      worst_partial = std::max({worst_partial, std::abs(results[i][1] - exact.g1), std::abs(results[i][2] - exact.g2),
                                std::abs(results[i][3] - exact.gt)});
    }
    std::cout << "random arguments, K " << silhouette.k << ": max error of g " << worst << ", of its partials "
              << worst_partial << "\n";
    EXPECT_LE(worst, tolerance);
    EXPECT_LE(worst_partial, 1e-3);
  }
}

}  // namespace
}  // namespace isofield::gpu_test
