#include "operators/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/finite_difference.h"

namespace isofield::operators {
namespace {

using Kind = Silhouette::Kind;

const Silhouette kSilhouettes[] = {
    {}, {Kind::kBulge, 0}, {Kind::kBulge, 0.1}, {Kind::kBulge, 0.5}, {Kind::kBulge, 0.9}, {Kind::kBulge, 1}};

TEST(Silhouette, PhiHasTheCheckedValues) {
  EXPECT_NEAR(phi(1).v, 0.80627872, 1e-8);
  EXPECT_NEAR(phi(2).v, 0.99999974, 1e-8);
}

TEST(Silhouette, PhiInvertsXPlusE) {
  for (double y = 0.01; y < 0.99; y += 0.01) {
    const Curve e = smooth_step_e(y);
    EXPECT_NEAR(phi(y + e.v).v, y, 1e-13) << y;
  }
}

TEST(Silhouette, PhiAndEHaveTheirDerivatives) {
  for (double x = 0.05; x < 0.95; x += 0.037) {
    const Curve e = smooth_step_e(x);
    EXPECT_NEAR(e.d1, test_support::slope([](double t) { return smooth_step_e(t).v; }, x, 1e-4), 1e-7) << x;
    EXPECT_NEAR(e.d2, test_support::slope([](double t) { return smooth_step_e(t).d1; }, x, 1e-4), 1e-5) << x;
  }
  for (double x = 0.05; x < 1.95; x += 0.037) {
    const Curve p = phi(x);
    EXPECT_NEAR(p.d1, test_support::slope([](double t) { return phi(t).v; }, x, 1e-4), 1e-8) << x;
    EXPECT_NEAR(p.d2, test_support::slope([](double t) { return phi(t).d1; }, x, 1e-4), 1e-7) << x;
  }
}

TEST(Silhouette, PhiIsFiniteToTheEnds) {
  for (const double x : {-1.0, 0.0, 1e-300, 1e-12, 2.6e-7, 1.99999, 2.0, 2.5, 50.0}) {
    const Curve p = phi(x);
    EXPECT_TRUE(std::isfinite(p.v) && std::isfinite(p.d1) && std::isfinite(p.d2)) << x;
  }
}

TEST(Silhouette, SmoothOneMeetsTheDiagonalWhereThePaperSays) {
  // s(pi/4) = sqrt(2) / q(1) = sqrt(2) phi(1). The note's 1.14025043 is right to 2e-7 only, while its phi(1) is right
  // to all digits.
  EXPECT_NEAR(std::numbers::sqrt2 / Silhouette{}.profile(1).v, std::numbers::sqrt2 * 0.80627872, 1e-8);
  EXPECT_NEAR(std::numbers::sqrt2 / Silhouette{}.profile(1).v, 1.14025043, 2e-7);
}

TEST(Silhouette, ProfileLiesOnTheCurve) {
  for (const Silhouette& s : kSilhouettes) {
    for (double u = 0.02; u <= 1; u += 0.02) {
      // M(a, b) = 1 holds at (x, y) = (u / q, 1 / q).
      const double q = s.profile(u).v, x = u / q, y = 1 / q;
      const double expected =
          s.kind == Kind::kSmooth ? 1 - smooth_step_e(x).v : 1 - s.k * std::exp(1 - 1 / x) * (1 - x);
      EXPECT_NEAR(y, expected, 1e-13) << "k " << s.k << " u " << u;
    }
  }
}

TEST(Silhouette, ProfileStartsFlatAtOneExactly) {
  for (const Silhouette& s : kSilhouettes) {
    EXPECT_EQ(s.profile(0).v, 1);
    EXPECT_EQ(s.profile(0).d1, 0);
    // Next to 0 the profile is as close to 1 as E(0) = 2.6e-7 allows.
    EXPECT_NEAR(s.profile(1e-9).v, 1, 3e-7);
  }
}

TEST(Silhouette, BulgeOfNoStrengthIsTheMaximum) {
  for (double u = 0; u <= 1; u += 0.1) EXPECT_EQ((Silhouette{Kind::kBulge, 0}.profile(u).v), 1);
}

TEST(Silhouette, ProfileHasItsDerivatives) {
  for (const Silhouette& s : kSilhouettes) {
    for (double u = 0.03; u < 0.97; u += 0.021) {
      const Curve q = s.profile(u);
      EXPECT_NEAR(q.d1, test_support::slope([&](double t) { return s.profile(t).v; }, u, 1e-4), 1e-7)
          << "k " << s.k << " u " << u;
      EXPECT_NEAR(q.d2, test_support::slope([&](double t) { return s.profile(t).d1; }, u, 1e-4),
                  1e-5 * std::max(1.0, std::abs(q.d2)))
          << "k " << s.k << " u " << u;
    }
  }
}

TEST(Silhouette, ProfileIsFiniteEverywhere) {
  for (const Silhouette& s : kSilhouettes) {
    for (const double u : {1e-320, 1e-200, 1e-100, 1e-17, 1e-3, 0.5, 1 - 1e-12, 1.0}) {
      const Curve q = s.profile(u);
      EXPECT_TRUE(std::isfinite(q.v) && std::isfinite(q.d1) && std::isfinite(q.d2)) << "k " << s.k << " u " << u;
      EXPECT_GE(q.v, 1) << "k " << s.k << " u " << u;
    }
  }
}

}  // namespace
}  // namespace isofield::operators
