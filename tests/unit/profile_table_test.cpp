#include "operators/profile_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>

namespace isofield::operators {
namespace {

struct Errors {
  double value = 0, slope = 0;
  double bend = 0;  // the second derivative: of silhouettes alone
};

// Largest errors of a table (coefficients in float32, evaluated in double) at 16 points a cell.
Errors errors_of(const std::string& name, const ProfileTable& table, double range,
                 const std::function<Curve(double)>& exact) {
  Errors worst;
  const double cell = range / static_cast<double>(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (int n = 0; n <= 15; ++n) {
      const double s = (n + 0.5) / 16;
      const auto& c = table[i];
      const double value = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
      const double slope = (c[1] + s * (2 * c[2] + 3 * s * c[3])) / cell;
      const Curve e = exact(cell * (static_cast<double>(i) + s));
      worst.value = std::max(worst.value, std::abs(value - e.v));
      worst.slope = std::max(worst.slope, std::abs(slope - e.d1));
    }
  }
  std::printf("%-24s %4zu cells: value off by %.2g, slope by %.2g\n", name.c_str(), table.size(), worst.value,
              worst.slope);
  return worst;
}

// The same for a silhouette's graded cells; derivatives relative to 1 + their size, since some are infinite.
Errors silhouette_errors(const std::string& name, const Silhouette& silhouette) {
  const ProfileTable table = silhouette_table(silhouette);
  EXPECT_EQ(table.size(), kSilhouetteCells + 1u);
  const Grading grading = Grading::of(silhouette);
  EXPECT_EQ(table[0], (CubicCell{static_cast<float>(grading.e), 0, 0, 0}));
  Errors worst;
  for (int i = 0; i < kSilhouetteCells; ++i) {
    const auto& c = table[i + 1];
    for (int n = 0; n <= 31; ++n) {
      // Closer and closer to the fold.
      const double s = i + 1 == kSilhouetteCells ? 1 - std::pow(0.5, 0.5 * n) : (n + 0.5) / 32;
      const double z = (i + s) / kSilhouetteCells;
      const double value = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
      const double slope = (c[1] + s * (2 * c[2] + 3 * s * c[3])) * kSilhouetteCells / grading.slope(z);
      const Curve e = silhouette.profile(1 - grading.w(z));
      worst.value = std::max(worst.value, std::abs(value - e.v));
      // Nearer to a fold the exact slope itself suffers from cancellation.
      if (grading.w(z) < 1e-9) continue;
      worst.slope = std::max(worst.slope, std::abs(slope - e.d1) / (1 + std::abs(e.d1)));
      if (grading.w(z) < 1e-4) continue;
      // dz/du = 1 / slope(z), whose own derivative is 2 / (n^2 slope(z)^3).
      const double along = grading.slope(z), n_cells = kSilhouetteCells;
      const double bend = (2 * c[2] + 6 * s * c[3]) * n_cells * n_cells / (along * along) +
                          slope * 2 / (grading.n() * grading.n() * along * along);
      worst.bend = std::max(worst.bend, std::abs(bend - e.d2) / (1 + std::abs(e.d2)));
    }
  }
  std::printf("%-24s %4d cells: value off by %.2g, slope by %.2g, bend by %.2g\n", name.c_str(), kSilhouetteCells,
              worst.value, worst.slope, worst.bend);
  return worst;
}

TEST(ProfileTable, SmoothSilhouetteIsClose) {
  const Errors e = silhouette_errors("smooth", {});
  EXPECT_LT(e.value, 4e-7);
  EXPECT_LT(e.slope, 2e-4);
}

TEST(ProfileTable, BulgesAreClose) {
  for (const double k : {0.0, 1e-6, 0.1, 0.25, 0.5, 0.8, 0.9, 0.95, 0.99, 0.995, 0.999, 0.9999, 0.999999, 1.0}) {
    const Errors e = silhouette_errors("bulge " + std::to_string(k), {Silhouette::Kind::kBulge, k});
    EXPECT_LT(e.value, 2e-7) << k;
    EXPECT_LT(e.slope, 2e-4) << k;
    EXPECT_LT(e.bend, 2e-3) << k;
  }
}

TEST(ProfileTable, TheStrongestBulgeIsFinite) {
  for (const auto& cell : silhouette_table({Silhouette::Kind::kBulge, 1})) {
    for (const float c : cell) ASSERT_TRUE(std::isfinite(c));
  }
}

TEST(ProfileTable, GradingReachesBothEnds) {
  for (const double k : {0.0, 0.25, 0.8, 0.99, 1.0}) {
    const Grading grading = Grading::of({Silhouette::Kind::kBulge, k});
    EXPECT_NEAR(grading.w(0), 1, 1e-12) << k;
    EXPECT_EQ(grading.w(1), 0) << k;
    for (const double z : {0.1, 0.5, 0.9}) {
      const double w = grading.w(z), h = 1e-6;
      EXPECT_NEAR(1 - grading.n() * w / (std::sqrt(grading.e * grading.e + w) + grading.e), z, 1e-12) << k;
      EXPECT_NEAR(grading.slope(z), (grading.w(z - h) - grading.w(z + h)) / (2 * h), 1e-8) << k;
    }
  }
}

// What an opening's table holds.
Curve tangent_of(const Opening& o, double alpha) {
  const Curve theta = o.theta(alpha);
  const double t = std::tan(theta.v);
  return {t, (1 + t * t) * theta.d1, 0};
}

TEST(ProfileTable, OpeningsAreClose) {
  const struct {
    const char* name;
    Opening opening;
    double most;
  } cases[] = {{"camel", camel(), 2e-7}, {"organic", organic(), 1e-6}, {"contact", contact(), 2e-6}};
  for (const auto& c : cases) {
    const Errors e = errors_of(c.name, opening_table(c.opening), std::numbers::pi,
                               [&](double alpha) { return tangent_of(c.opening, alpha); });
    EXPECT_LT(e.value, c.most) << c.name;
  }
}

TEST(ProfileTable, TheSteepestOpeningsStayWithinTheirParameters) {
  for (const double w : {0.05, 0.3, 3.0, 20.0}) {
    Opening o = camel();
    o.w0 = o.w1 = w;
    const ProfileTable table = opening_table(o);
    errors_of("camel, w " + std::to_string(w), table, std::numbers::pi, [&](double a) { return tangent_of(o, a); });
    for (const auto& c : table) {
      for (double s = 0; s <= 1; s += 0.125) {
        const double tangent = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
        EXPECT_GE(tangent, -5e-4) << w;
        EXPECT_LE(tangent, 1 + 1e-6) << w;
      }
    }
  }
}

TEST(ProfileTable, CellsMeetWithValueAndSlope) {
  for (const auto& [table, first] : {std::pair{silhouette_table({}), 1u}, std::pair{opening_table(organic()), 0u}}) {
    for (std::size_t i = first; i + 1 < table.size(); ++i) {
      const auto& c = table[i];
      EXPECT_NEAR(c[0] + c[1] + c[2] + c[3], table[i + 1][0], 3e-7);
      EXPECT_NEAR(c[1] + 2 * c[2] + 3 * c[3], table[i + 1][1], 3e-7);
    }
  }
}

TEST(ProfileTable, BoundHolds) {
  for (const double k : {0.1, 0.5, 0.8, 0.95, 1.0}) {
    const Silhouette s{Silhouette::Kind::kBulge, k};
    const double bound = silhouette_bound(s);
    for (int i = 1; i <= 20000; ++i) {
      const double u = i / 20000.0;
      ASSERT_LE(s.profile(u).v, 1 + bound * u) << "k " << k << " u " << u;
    }
  }
  const double bound = silhouette_bound({});
  for (int i = 1; i <= 20000; ++i) ASSERT_LE(Silhouette{}.profile(i / 20000.0).v, 1 + bound * i / 20000.0);
}

}  // namespace
}  // namespace isofield::operators
