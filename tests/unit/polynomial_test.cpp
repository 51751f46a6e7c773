#include "operators/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "operators/silhouette.h"

namespace isofield::operators {
namespace {

// Evaluates the value and the slope at s with coefficients and sums in float32, as the device does.
Curve evaluate(const Polynomial& p, float s) {
  float value = 0, slope = 0;
  for (std::size_t k = p.size(); k-- > 0;) value = value * s + static_cast<float>(p[k]);
  for (std::size_t k = p.size(); k-- > 1;) slope = slope * s + static_cast<float>(static_cast<double>(k) * p[k]);
  return {value, slope, 0};
}

void expect_close(const char* name, const Polynomial& p, double low, double high,
                  const std::function<Curve(double)>& exact) {
  double value = 0, slope = 0;
  for (int i = 1; i < 20'000; ++i) {
    const double s = -1 + 2 * i / 20'000.0;
    const Curve c = evaluate(p, static_cast<float>(s)), e = exact(low + (high - low) * (s + 1) / 2);
    value = std::max(value, std::abs(c.v - e.v));
    slope = std::max(slope, std::abs(c.d1 * 2 / (high - low) - e.d1));
  }
  std::printf("%s: value off by %.2g, slope by %.2g\n", name, value, slope);
  EXPECT_LT(value, 2e-7);
  EXPECT_LT(slope, 8e-6);
}

TEST(Polynomial, ReproducesPolynomials) {
  const Polynomial p = fit_polynomial([](double x) { return x * x * x; }, 1, 3, 4);  // (2 + s)^3
  ASSERT_EQ(p.size(), 4u);
  EXPECT_NEAR(p[0], 8, 1e-12);
  EXPECT_NEAR(p[1], 12, 1e-12);
  EXPECT_NEAR(p[2], 6, 1e-12);
  EXPECT_NEAR(p[3], 1, 1e-12);
}

TEST(Polynomial, ProfilesAreClose) {
  expect_close("phi on [1, 2]", phi_polynomial(), 1, 2, phi);
  expect_close("smooth profile", smooth_profile_polynomial(), 0, 1, [](double u) { return Silhouette{}.profile(u); });
}

TEST(Polynomial, PowersAreMadeOfExactParts) {
  const Polynomial logarithm = logarithm_polynomial(), exponential = exponential_polynomial();
  const auto at = [](const Polynomial& p, double s) {
    double value = 0;
    for (std::size_t k = p.size(); k-- > 0;) value = value * s + p[k];
    return value;
  };
  for (double s = -1; s <= 1; s += 1e-3) {
    const double low = std::sqrt(0.5) - 1, high = std::sqrt(2) - 1, f = low + (high - low) * (s + 1) / 2;
    const double log2_e = 1 / std::log(2);
    EXPECT_NEAR(log2_e * (f - f * f / 2) + f * f * f * at(logarithm, s), std::log2(1 + f), 2e-9) << f;
    EXPECT_NEAR(at(exponential, s), std::exp2(s / 2), 2e-9) << s;
  }
  EXPECT_EQ(static_cast<float>(exponential[0]), 1.0f);
}

TEST(Polynomial, PhiMirrors) {
  for (double x = 0.01; x < 1; x += 0.01) EXPECT_NEAR(phi(x).v, phi(2 - x).v - 1 + x, 1e-6) << x;
}

TEST(Polynomial, GlslSumsByPairs) {
  const std::string code = polynomial_glsl("f", {1, 2, 3});
  EXPECT_NE(code.find("float f_value(float s)"), std::string::npos);
  EXPECT_NE(code.find("a0_0 = 1.000000000e+00 + 2.000000000e+00 * s"), std::string::npos) << code;
  EXPECT_NE(code.find("a0_0 + 3.000000000e+00 * s1"), std::string::npos) << code;
}

}  // namespace
}  // namespace isofield::operators
