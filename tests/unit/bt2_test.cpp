// Compares the conic blend as the paper writes it with the form that is free of cancellation.
#include "operators/bt2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/random_scene.h"

namespace isofield::operators {
namespace {

using test_support::Random;

struct Conic {
  double r1, r2, m1, m2, p;

  double tightness() const { return 1 - p / (r1 * r2); }
  Binary<double> at(double x1, double x2) const { return Bt2::blend<double>(x1, x2, {r1, m1}, {r2, m2}, tightness()); }
};

// Returns the root of the quadratic of [H] eq. 4 that lies within its bracket.
long double root_of_quadratic(const Conic& k, long double x1, long double x2) {
  const long double r1 = k.r1, r2 = k.r2, m1 = k.m1, m2 = k.m2, p = k.p;
  const long double least = std::min(x1 / m1, x2 / m2);
  if (m2 * x1 - m1 * (x2 - r2) <= 0 || m2 * (x1 - r1) - m1 * x2 >= 0) return least;
  const long double a = r1 * r1 * m2 * m2 + r2 * r2 * m1 * m1 + 2 * p * m1 * m2;
  const long double b = 2 * ((r2 - x2) * r1 * r1 * m2 + (r1 - x1) * r2 * r2 * m1 - (x1 * m2 + x2 * m1) * p);
  const long double level = r1 * x2 + r2 * x1 - r1 * r2, c = level * level + 2 * (p - r1 * r2) * x1 * x2;
  const long double low = level / (r1 * m2 + r2 * m1), root = std::sqrt(std::max(b * b - 4 * a * c, 0.0L));
  long double nearest = NAN, most_within = -INFINITY;
  for (const long double h : {(-b + root) / (2 * a), (-b - root) / (2 * a)}) {
    const long double within = std::min(h - low, least - h);
    if (within > most_within) nearest = h, most_within = within;
  }
  return nearest;
}

TEST(Bt2, IsTheRootThatThePaperGives) {
  Random random(7);
  double worst = 0, worst_partial = 0;
  int blended = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto factor = [&] { return std::pow(10, random.number(-1, 1)); };
    Conic k{factor(), factor(), factor(), factor(), 0};
    // The conics range from nearly the straight cut to nearly the union.
    k.p = k.r1 * k.r2 * (1 - std::pow(10, random.number(-4, 6)));
    // Half of the points lie within the blended region.
    const double x2 = random.number(-2, 2), s = n % 2 == 0 ? random.number(0, 1) : random.number(-1, 2);
    const double x1 = k.m1 * ((x2 - k.r2) / k.m2 + s * (k.r1 / k.m1 + k.r2 / k.m2));
    const Binary<double> g = k.at(x1, x2);
    const double scale = std::max({1.0, std::abs(x1 / k.m1), std::abs(x2 / k.m2), k.r1 / k.m1, k.r2 / k.m2});
    worst = std::max(worst, static_cast<double>(std::abs(g.g - root_of_quadratic(k, x1, x2))) / scale);
    if (g.g1 == 0 || g.g2 == 0) continue;
    ++blended;
    // The level moves as the fields do, B(x + m h) = B(x) + h.
    worst_partial = std::max(worst_partial, std::abs(g.g1 * k.m1 + g.g2 * k.m2 - 1));
    const double step = 1e-6 * k.r1, slope = (k.at(x1 + step, x2).g - k.at(x1 - step, x2).g) / (2 * step);
    // the blend bends within the step
    if (std::abs(k.at(x1 + step, x2).g1 - k.at(x1 - step, x2).g1) * k.m1 > 1e-4) continue;
    worst_partial = std::max(worst_partial, std::abs(g.g1 - slope) * k.m1);
  }
  std::printf("values off by %.2g, partials by %.2g; %d of them blended\n", worst, worst_partial, blended);
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(worst_partial, 1e-6);
  EXPECT_GT(blended, 10000);
}

TEST(Bt2, NearsTheUnionAsItsConicTightens) {
  for (const double tightness : {1e2, 1e6, 1e10, 1e14}) {
    const Conic k{0.7, 0.7, 1, 1, 0.49 * (1 - tightness)};
    EXPECT_NEAR(k.at(0.2, 0.2).g, 0.2 - 0.5 * std::sqrt(2 / tightness) * 0.7, 0.7 / tightness);
    EXPECT_DOUBLE_EQ(k.at(0.2, 0.2).g1, 0.5);
  }
}

}  // namespace
}  // namespace isofield::operators
