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

TEST(ProfileTable, SmoothSilhouetteIsClose) {
  const Silhouette s;
  const Errors e = errors_of("smooth", silhouette_table(s), 1, [&](double u) { return s.profile(u); });
  EXPECT_LT(e.value, 4e-7);
  EXPECT_LT(e.slope, 2e-4);
}

TEST(ProfileTable, BulgesAreClose) {
  for (const double k : {0.0, 0.1, 0.25, 0.5, 0.8, 0.9}) {
    const Silhouette s{Silhouette::Kind::kBulge, k};
    const Errors e =
        errors_of("bulge " + std::to_string(k), silhouette_table(s), 1, [&](double u) { return s.profile(u); });
    EXPECT_LT(e.value, k <= 0.8 ? 2e-6 : 2e-4) << k;
    EXPECT_LT(e.slope, k <= 0.8 ? 3e-3 : 0.1) << k;
  }
}

TEST(ProfileTable, TheStrongestBulgeIsFiniteAndClose) {
  const Silhouette s{Silhouette::Kind::kBulge, 1};
  const ProfileTable table = silhouette_table(s);
  for (const auto& cell : table) {
    for (const float c : cell) ASSERT_TRUE(std::isfinite(c));
  }
  EXPECT_LT(errors_of("bulge 1", table, 1, [&](double u) { return s.profile(u); }).value, 2e-2);
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
  for (const ProfileTable& table : {silhouette_table({}), opening_table(organic())}) {
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
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
