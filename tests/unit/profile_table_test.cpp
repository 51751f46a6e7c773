#include "operators/profile_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace isofield::operators {
namespace {

struct Errors {
  double value = 0, slope = 0;
  double bend = 0;  // the second derivative; for silhouettes only
};

// Returns the largest errors of a table (coefficients in float32, evaluated in double). Errors of derivatives are
// relative to 1 + their size, since some derivatives are infinite.
Errors silhouette_errors(const std::string& name, const Silhouette& silhouette) {
  const ProfileTable table = silhouette_table(silhouette);
  EXPECT_EQ(table.size(), kSilhouetteCells + 1u);
  const Grading grading = Grading::of(silhouette);
  EXPECT_EQ(table[0], (CubicCell{static_cast<float>(grading.e), 0, 0, 0}));
  Errors worst;
  for (int i = 0; i < kSilhouetteCells; ++i) {
    const auto& c = table[i + 1];
    for (int n = 0; n <= 31; ++n) {
      // In the last cell the places come closer and closer to the fold.
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

// Returns tan(theta) of an opening at alpha, which its table holds, with its derivative.
Curve tangent_of(const Opening& o, double alpha) {
  const Curve theta = o.theta(alpha);
  const double t = std::tan(theta.v);
  return {t, (1 + t * t) * theta.d1, 0};
}

// Looks up an opening as shaders/lib/profiles.glsl does, but in double.
Curve look_up(const ProfileTable& table, double alpha) {
  const auto cubic = [&](std::size_t cell, double s, double per_unit) -> Curve {
    const auto& c = table[1 + cell];
    return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), per_unit * (c[1] + s * (2 * c[2] + 3 * s * c[3])), 0};
  };
  const auto& [first, second, third, fourth] = table[0];
  if (fourth < 0) {
    const double cell = std::min(std::floor(alpha * third), -fourth - 1.0);
    const Curve theta = cubic(static_cast<std::size_t>(cell), (alpha - cell * first - cell * second) * third, third);
    const double t = std::tan(theta.v);
    return {t, (1 + t * t) * theta.d1, 0};
  }
  const bool is_left = alpha < first;
  const double per_unit = is_left ? -second : third;
  const double place = std::min((alpha - first) * per_unit + kFirstPlace, 1.0 - 0x1p-24);
  const double octave = std::exp2(std::floor(std::log2(place)));
  const int per_octave = 1 << (23 - std::bit_cast<int>(fourth));
  const double cell = std::floor((place / octave - 1) * per_octave);
  const double before = std::log2(octave / kFirstPlace) + (is_left ? kRampOctaves : 0);
  const auto number = static_cast<std::size_t>(before * per_octave + cell);
  return cubic(number, place - octave * (1 + cell / per_octave), per_unit);
}

// Returns the largest errors at `count` angles within [low, high]. The slope's error is relative to the steepest slope
// there.
Errors opening_errors(const Opening& o, double low, double high, int count = 5000) {
  const ProfileTable table = opening_table(o);
  Errors worst;
  double steepest = 0;
  for (int i = 0; i <= count; ++i) {
    const double alpha = low + (high - low) * i / count;
    const Curve exact = tangent_of(o, alpha), found = look_up(table, alpha);
    worst.value = std::max(worst.value, std::abs(found.v - exact.v));
    worst.slope = std::max(worst.slope, std::abs(found.d1 - exact.d1));
    steepest = std::max(steepest, std::abs(exact.d1));
  }
  if (steepest > 0) worst.slope /= steepest;
  return worst;
}

TEST(ProfileTable, OpeningsAreClose) {
  const std::pair<const char*, Opening> openings[] = {
      {"camel", camel()}, {"organic", organic()}, {"contact", contact()}};
  for (const auto& [name, o] : openings) {
    for (const auto& [low, high] : {std::pair{0.0, o.alpha1}, std::pair{o.alpha1, std::numbers::pi}}) {
      const Errors e = opening_errors(o, low, high);
      std::printf("%-24s %4zu cells: value off by %.2g, slope by %.2g\n", name, opening_table(o).size() - 1, e.value,
                  e.slope);
      EXPECT_LT(e.value, 1e-7) << name;
      EXPECT_LT(e.slope, 3e-6) << name;
    }
  }
}

// The openings have slopes of all sizes, and short and long ramps.
TEST(ProfileTable, SteepOpeningsAreClose) {
  Errors worst;
  for (const double w : {0.05, 0.099, 0.1, 0.3, 1.0, 3.0, 3.1, 8.0, 20.0}) {
    for (const double ramp : {kLeastRamp, 0.0175, 0.5, 1.5}) {
      for (const double alpha1 : {ramp, 1.57, std::numbers::pi - ramp}) {
        Opening o{alpha1 - ramp, alpha1, alpha1 + ramp, std::numbers::pi / 4, 0, std::numbers::pi / 4, w, w};
        for (const double side : {-ramp, ramp}) {
          const Errors e = opening_errors(o, alpha1, alpha1 + 1.1 * side);
          worst = {std::max(worst.value, e.value), std::max(worst.slope, e.slope)};
          EXPECT_LT(e.value, 1e-7) << "w " << w << " ramp " << ramp;
          EXPECT_LT(e.slope, 3e-6) << "w " << w << " ramp " << ramp;
        }
      }
    }
  }
  std::printf("steep openings: value off by %.2g, slope by %.2g\n", worst.value, worst.slope);
}

TEST(ProfileTable, SampledOpeningsAreTheirOwnCubics) {
  for (const int samples : {3, 4, 11, 100, 4096}) {
    std::vector<double> theta;
    for (int i = 0; i < samples; ++i) theta.push_back(i % 5 < 2 ? 0 : std::numbers::pi / 4);
    Opening o{};
    o.samples = SampledCurve::even(0, std::numbers::pi, theta);
    const Errors e = opening_errors(o, 0, std::numbers::pi, 20'000);
    EXPECT_LT(e.value, 1e-7) << samples;
    EXPECT_LT(e.slope, 1e-6) << samples;
    EXPECT_EQ(opening_table(o).size(), static_cast<std::size_t>(samples)) << samples;
  }
}

TEST(ProfileTable, CellsMeetWithValueAndSlope) {
  const ProfileTable table = silhouette_table({});
  for (std::size_t i = 1; i + 1 < table.size(); ++i) {
    const auto& c = table[i];
    EXPECT_NEAR(c[0] + c[1] + c[2] + c[3], table[i + 1][0], 3e-7);
    EXPECT_NEAR(c[1] + 2 * c[2] + 3 * c[3], table[i + 1][1], 3e-7);
  }
  const ProfileTable opening = opening_table(organic());
  const int per_octave = cells_per_octave(organic());
  for (int i = 0; i + 1 < kRampOctaves * per_octave; ++i) {
    const auto& c = opening[1 + i];
    const double s = std::ldexp(kFirstPlace, i / per_octave) / per_octave;  // the cell's width
    EXPECT_NEAR(c[0] + s * (c[1] + s * (c[2] + s * c[3])), opening[2 + i][0], 3e-7);
    EXPECT_NEAR(c[1] + s * (2 * c[2] + 3 * s * c[3]), opening[2 + i][1], 3e-6);
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
