#include "operators/opening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "support/finite_difference.h"
#include "support/random_scene.h"
#include "support/shared_files.h"

namespace isofield::operators {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Opening, KappaRunsFromZeroToOneAndIsFlatAtBothEnds) {
  EXPECT_EQ(kappa(0).v, 0);
  EXPECT_EQ(kappa(1).v, 1);
  EXPECT_EQ(kappa(0).d1, 0);
  EXPECT_EQ(kappa(1).d1, 0);
  EXPECT_LT(kappa(0.02).d1, 1e-9);
  EXPECT_LT(kappa(0.98).d1, 1e-9);
  for (double x = 0.01; x < 0.99; x += 0.01) EXPECT_LE(kappa(x).v, kappa(x + 0.01).v);
}

TEST(Opening, KappaHasItsDerivative) {
  for (double x = 0.05; x < 0.95; x += 0.03) {
    EXPECT_NEAR(kappa(x).d1, test_support::slope([](double t) { return kappa(t).v; }, x, 1e-4), 1e-8) << x;
  }
}

TEST(Opening, TurnedIsTheSameSeenFromTheOtherEnd) {
  Opening sampled{};
  sampled.samples = SampledCurve::even(0, kPi, {0.1, 0.7, 0.2, 0.2, 0.5});
  Opening steep = organic();
  steep.w0 = 0.05;
  for (const Opening& o : {contact(), organic(), steep, sampled}) {
    const Opening turned = o.turned();
    EXPECT_EQ(turned.theta_min(), o.theta_min());
    for (double alpha = 0; alpha <= kPi; alpha += 0.01) {
      EXPECT_NEAR(turned.theta(alpha).v, o.theta(kPi - alpha).v, 1e-12) << alpha;
      EXPECT_NEAR(turned.theta(alpha).d1, -o.theta(kPi - alpha).d1, 1e-12) << alpha;
    }
  }
}

// A small exponent raises kappa's smallest values to visible ones, so they must have a small relative error.
TEST(Opening, SmallSlopesStayContinuousAtTheMiddle) {
  Opening o = camel();
  o.w0 = o.w1 = 0.05;
  double before = o.theta1;
  for (double beyond = 1e-5; beyond < 0.3; beyond *= 1.02) {
    const double theta = o.theta(o.alpha1 + beyond).v;
    EXPECT_GE(theta, before) << beyond;
    EXPECT_LT(theta - before, 0.03) << beyond;
    before = theta;
  }
}

TEST(Opening, PassesThroughItsParameters) {
  for (const Opening& o : {camel(), organic(), contact()}) {
    EXPECT_EQ(o.theta(0).v, o.theta0);
    EXPECT_NEAR(o.theta(o.alpha1).v, o.theta1, 1e-15);
    EXPECT_EQ(o.theta(kPi).v, o.theta2);
    EXPECT_EQ(o.theta_min(), std::min({o.theta0, o.theta1, o.theta2}));
  }
}

TEST(Opening, StaysBetweenItsParametersAndHasItsDerivative) {
  test_support::Random random(1);
  for (int n = 0; n < 200; ++n) {
    Opening o{random.number(0, 0.8),     random.number(0.9, 1.8),   random.number(1.9, kPi), random.number(0, kPi / 4),
              random.number(0, kPi / 4), random.number(0, kPi / 4), random.number(0.3, 5),   random.number(0.3, 5)};
    const double high = std::max({o.theta0, o.theta1, o.theta2});
    for (double alpha = 0.01; alpha < kPi; alpha += 0.0731) {
      const Curve theta = o.theta(alpha);
      EXPECT_GE(theta.v, o.theta_min() - 1e-15);
      EXPECT_LE(theta.v, high + 1e-15);
      const auto slope = test_support::settled_slope([&](double a) { return o.theta(a).v; }, alpha, 1e-4, 1e-6);
      if (slope) {
        EXPECT_NEAR(theta.d1, *slope, 2e-6 * std::max(1.0, std::abs(*slope))) << alpha;
      }
    }
  }
}

TEST(Opening, IsFiniteForTheMostExtremeSlopes) {
  for (const double w : {0.05, 20.0}) {
    Opening o = camel();
    o.w0 = o.w1 = w;
    for (double alpha = 0; alpha <= kPi; alpha += 1e-3) {
      const Curve theta = o.theta(alpha);
      ASSERT_TRUE(std::isfinite(theta.v) && std::isfinite(theta.d1)) << alpha;
    }
    for (double off = 1; off > 1e-320; off /= 3) {
      for (const double alpha : {o.alpha1 + off, o.alpha1 - off, o.alpha0 + off, o.alpha2 - off}) {
        const Curve theta = o.theta(alpha);
        ASSERT_TRUE(std::isfinite(theta.v) && std::isfinite(theta.d1)) << alpha;
      }
    }
  }
}

void expect_golden(const std::string& name, const Opening& opening) {
  const auto table = test_support::read_csv(test_support::checkout_file("tests/golden/" + name));
  ASSERT_TRUE(table.ok()) << table.status().message();
  ASSERT_EQ(table->columns, (std::vector<std::string>{"alpha", "theta"}));
  ASSERT_GT(table->rows.size(), 100u);
  double worst = 0;
  for (const auto& row : table->rows) {
    worst = std::max(worst, std::abs(opening.theta(row[0]).v - row[1]));
    EXPECT_NEAR(opening.theta(row[0]).v, row[1], 2e-8) << "alpha " << row[0];
  }
  std::printf("%s: %zu rows, largest difference %.2g\n", name.c_str(), table->rows.size(), worst);
}

TEST(Opening, GoldenCamel) {
  expect_golden("opening_camel.csv", camel());
}
TEST(Opening, GoldenOrganic) {
  expect_golden("opening_organic.csv", organic());
}
TEST(Opening, GoldenContact) {
  expect_golden("opening_contact.csv", contact());
}

}  // namespace
}  // namespace isofield::operators
