#include "operators/gradient_blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "support/finite_difference.h"
#include "support/random_scene.h"
#include "support/shared_files.h"

namespace isofield::operators {
namespace {

using test_support::Random;
using test_support::settled_slope;
using Kind = Silhouette::Kind;

constexpr double kQuarter = std::numbers::pi / 4;

const Silhouette kSilhouettes[] = {
    {}, {Kind::kBulge, 0.1}, {Kind::kBulge, 0.25}, {Kind::kBulge, 0.8}, {Kind::kBulge, 1}};

bool is_finite(const Blend& b) {
  for (const double x : {b.g, b.g1, b.g2, b.gt, b.g11, b.g12, b.g22, b.g1t, b.g2t}) {
    if (!std::isfinite(x)) return false;
  }
  return true;
}

TEST(GradientBlend, HasTheCheckedValues) {
  EXPECT_NEAR(gradient_blend(0.5, 0.5, 0, {}).g, 0.62013295, 1e-8);
  EXPECT_NEAR(gradient_blend(0.3, 0.3, kQuarter, {}).g, 0.32219572, 1e-8);
  EXPECT_NEAR(gradient_blend(0.7, 0.7, kQuarter, {}).g, 0.74805318, 1e-8);
}

TEST(GradientBlend, IdentitiesAreExact) {
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const Silhouette& s = kSilhouettes[random.integer(0, 4)];
    const double f = random.number(0, 1.5), theta = random.number(0, kQuarter);
    EXPECT_EQ(gradient_blend(f, 0, theta, s).g, f);
    EXPECT_EQ(gradient_blend(0, f, theta, s).g, f);
    EXPECT_EQ(gradient_blend(f, 0, theta, s).g1, 1);
    EXPECT_EQ(gradient_blend(0, 0, theta, s).g, 0);
    const double other = random.number(0, 1.5);
    const Blend ab = gradient_blend(f, other, theta, s), ba = gradient_blend(other, f, theta, s);
    EXPECT_EQ(ab.g, ba.g);
    EXPECT_EQ(ab.g1, ba.g2);
    EXPECT_EQ(ab.g11, ba.g22);
    EXPECT_EQ(ab.g1t, ba.g2t);
  }
}

TEST(GradientBlend, LiesBetweenTheMaximumAndTheWidestBlend) {
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const double f1 = random.number(0, 1.5), f2 = random.number(0, 1.5), theta = random.number(0, kQuarter);
    const double g = gradient_blend(f1, f2, theta, {}).g;
    EXPECT_GE(g, std::max(f1, f2));
    EXPECT_LE(g, gradient_blend(f1, f2, 0, {}).g + 1e-15);
  }
}

TEST(GradientBlend, KeepsRelativePrecisionForTinyFields) {
  // The operator is homogeneous of degree 1 at theta = 0.
  const double unit = gradient_blend(1, 0.7, 0, {}).g;
  for (const double f : {1e-5, 1e-20, 1e-47, 1e-100, 1e-200}) {
    EXPECT_NEAR(gradient_blend(f, 0.7 * f, 0, {}).g / f, unit, 1e-12) << f;
  }
}

TEST(GradientBlend, BoundaryHasItsDerivatives) {
  Random random(4);
  int checked = 0;
  for (int n = 0; n < 4000; ++n) {
    const double f = random.number(0.01, 0.9), t = random.number(0.02, 0.98);
    const Boundary k = boundary(f, t);
    const auto expect = [&](double exact, auto function, double at, const char* which) {
      const auto slope = settled_slope(function, at, 1e-4, 1e-6);
      if (!slope) return;
      ++checked;
      EXPECT_NEAR(exact, *slope, 3e-6 * std::max(1.0, std::abs(*slope))) << which << " f " << f << " t " << t;
    };
    expect(
        k.k_f, [&](double x) { return boundary(x, t).k; }, f, "k_f");
    expect(
        k.k_ff, [&](double x) { return boundary(x, t).k_f; }, f, "k_ff");
    expect(
        k.k_t, [&](double x) { return boundary(f, x).k; }, t, "k_t");
    expect(
        k.k_ft, [&](double x) { return boundary(x, t).k_t; }, f, "k_ft from k_t");
    expect(
        k.k_ft, [&](double x) { return boundary(f, x).k_f; }, t, "k_tf");
  }
  EXPECT_GT(checked, 17000);
}

TEST(GradientBlend, BoundaryEndsAreThoseOfThePaper) {
  for (double t = 0.05; t < 1; t += 0.05) {
    EXPECT_EQ(boundary(0.7, t).k, t / 2);
    EXPECT_NEAR(boundary(0.5 - 1e-12, t).k, t / 2, 4e-7);  // phi(2) = 0.99999974
    EXPECT_EQ(boundary(0, t).k, 0);
  }
  for (double f = 0; f < 0.5; f += 0.05) EXPECT_NEAR(boundary(f, 1).k, 2 * f * f, 1e-15);
}

TEST(GradientBlend, HasItsDerivatives) {
  Random random(5);
  int tried = 0, checked = 0;
  for (int n = 0; n < 3000; ++n) {
    const Silhouette& s = kSilhouettes[random.integer(0, 4)];
    const double f1 = random.number(0.02, 1.4), f2 = random.number(0.02, 1.4),
                 th = random.number(0.01, kQuarter - 0.01);
    const Blend b = gradient_blend(f1, f2, th, s);
    const auto expect = [&](double exact, auto function, double at, const char* which) {
      ++tried;
      const auto slope = settled_slope(function, at, 1e-4, 1e-5);
      if (!slope) return;
      ++checked;
      EXPECT_NEAR(exact, *slope, 2e-5 * std::max(1.0, std::abs(*slope)))
          << which << " f " << f1 << " " << f2 << " theta " << th << " k " << s.k;
    };
    expect(
        b.g1, [&](double x) { return gradient_blend(x, f2, th, s).g; }, f1, "g1");
    expect(
        b.g2, [&](double x) { return gradient_blend(f1, x, th, s).g; }, f2, "g2");
    expect(
        b.gt, [&](double x) { return gradient_blend(f1, f2, x, s).g; }, th, "gt");
    expect(
        b.g11, [&](double x) { return gradient_blend(x, f2, th, s).g1; }, f1, "g11");
    expect(
        b.g12, [&](double x) { return gradient_blend(f1, x, th, s).g1; }, f2, "g12");
    expect(
        b.g12, [&](double x) { return gradient_blend(x, f2, th, s).g2; }, f1, "g21");
    expect(
        b.g22, [&](double x) { return gradient_blend(f1, x, th, s).g2; }, f2, "g22");
    expect(
        b.g1t, [&](double x) { return gradient_blend(f1, f2, x, s).g1; }, th, "g1t");
    expect(
        b.g2t, [&](double x) { return gradient_blend(f1, f2, x, s).g2; }, th, "g2t");
  }
  std::printf("partials of g: %d of %d checked\n", checked, tried);
  EXPECT_GT(checked, tried * 9 / 10);
}

TEST(GradientBlend, IsFiniteEverywhere) {
  const double fields[] = {0,   1e-200, 1e-100,    1e-47, 1e-16, 1e-6, 0.1, 0.25, 0.5 - 1e-16,
                           0.5, 0.7,    1 - 1e-16, 1,     1.5,   3,    100, 1e6};
  const double thetas[] = {0, 1e-300, 1e-12, 0.1, kQuarter / 2, kQuarter - 1e-12, kQuarter};
  for (const Silhouette& s : kSilhouettes) {
    for (const double theta : thetas) {
      for (const double f1 : fields) {
        for (const double f2 : fields) {
          const Blend b = gradient_blend(f1, f2, theta, s);
          EXPECT_TRUE(is_finite(b)) << f1 << " " << f2 << " theta " << theta << " k " << s.k;
          EXPECT_GE(b.g, std::max(f1, f2));
        }
      }
    }
  }
}

void expect_golden(const std::string& name, const Silhouette& silhouette) {
  const auto table = test_support::read_csv(test_support::checkout_file("tests/golden/" + name));
  ASSERT_TRUE(table.ok()) << table.status().message();
  ASSERT_EQ(table->columns, (std::vector<std::string>{"f1", "f2", "theta", "g"}));
  ASSERT_GT(table->rows.size(), 100u);
  double worst = 0;
  for (const auto& row : table->rows) {
    const double g = gradient_blend(row[0], row[1], row[2], silhouette).g;
    worst = std::max(worst, std::abs(g - row[3]));
    EXPECT_NEAR(g, row[3], 2e-8) << row[0] << " " << row[1] << " theta " << row[2];
  }
  std::printf("%s: %zu rows, largest difference %.2g\n", name.c_str(), table->rows.size(), worst);
}

TEST(GradientBlend, GoldenSmooth) {
  expect_golden("gradient_smooth.csv", {});
}
TEST(GradientBlend, GoldenBulgeQuarter) {
  expect_golden("gradient_bulge_0.25.csv", {Kind::kBulge, 0.25});
}
TEST(GradientBlend, GoldenBulgeFourFifths) {
  expect_golden("gradient_bulge_0.8.csv", {Kind::kBulge, 0.8});
}

}  // namespace
}  // namespace isofield::operators
