#include "engine/surface/iso_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/random_scene.h"

namespace isofield::engine {
namespace {

using Counts = std::array<std::uint32_t, 2>;

std::vector<float> sampled(const Counts& counts, const std::function<double(double, double)>& f) {
  std::vector<float> values;
  for (std::uint32_t j = 0; j < counts[1]; ++j) {
    for (std::uint32_t i = 0; i < counts[0]; ++i) values.push_back(static_cast<float>(f(i, j)));
  }
  return values;
}

struct Line {
  std::vector<std::array<float, 2>> points;

  bool is_closed() const { return points.front() == points.back(); }
  // The area that a closed line goes around, positive where it goes counter-clockwise.
  double area() const {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      sum += (double{points[k][0]} * points[k + 1][1] - double{points[k + 1][0]} * points[k][1]) / 2;
    }
    return sum;
  }
};

std::vector<Line> lines_of(const std::vector<float>& values, const Counts& counts, float level) {
  const Polylines all = iso_lines(values, counts, level);
  EXPECT_EQ(2 * all.starts.back(), all.points.size());
  std::vector<Line> lines;
  for (std::size_t n = 0; n + 1 < all.starts.size(); ++n) {
    Line& line = lines.emplace_back();
    for (std::size_t p = all.starts[n]; p < all.starts[n + 1]; ++p) {
      line.points.push_back({all.points[2 * p], all.points[2 * p + 1]});
    }
    EXPECT_GE(line.points.size(), 2u);
  }
  return lines;
}

TEST(IsoLines, OfALinearFieldAreStraightWithGreaterValuesOnTheLeft) {
  const std::vector<Line> upright = lines_of(sampled({4, 3}, [](double x, double) { return x; }), {4, 3}, 1.25f);
  ASSERT_EQ(upright.size(), 1u);
  EXPECT_EQ(upright[0].points, (std::vector<std::array<float, 2>>{{1.25f, 2}, {1.25f, 1}, {1.25f, 0}}));

  const std::vector<Line> slanted =
      lines_of(sampled({5, 4}, [](double x, double y) { return 2 * x + y; }), {5, 4}, 4.5f);
  ASSERT_EQ(slanted.size(), 1u);
  for (const auto& [x, y] : slanted[0].points) EXPECT_FLOAT_EQ(2 * x + y, 4.5f);
  EXPECT_EQ(slanted[0].points.front(), (std::array<float, 2>{0.75f, 3}));
  EXPECT_EQ(slanted[0].points.back(), (std::array<float, 2>{2.25f, 0}));
}

TEST(IsoLines, OfACircularFieldAreClosedAndRound) {
  const Counts counts{41, 43};
  const double radius = 15.3;
  const std::vector<Line> disc =
      lines_of(sampled(counts, [&](double x, double y) { return radius - std::hypot(x - 20.2, y - 21.7); }), counts, 0);
  ASSERT_EQ(disc.size(), 1u);
  EXPECT_TRUE(disc[0].is_closed());
  for (const auto& [x, y] : disc[0].points) EXPECT_NEAR(std::hypot(x - 20.2, y - 21.7), radius, 0.01);
  EXPECT_NEAR(disc[0].area(), M_PI * radius * radius, 1);

  // A ring has an outer border of radius 16, and an inner one of radius 8 that goes the other way around.
  std::vector<Line> ring = lines_of(
      sampled(counts, [](double x, double y) { return 4 - std::abs(std::hypot(x - 20, y - 21) - 12); }), counts, 0);
  ASSERT_EQ(ring.size(), 2u);
  if (ring[0].area() < 0) std::swap(ring[0], ring[1]);
  EXPECT_TRUE(ring[0].is_closed() && ring[1].is_closed());
  EXPECT_NEAR(ring[0].area(), M_PI * 16 * 16, 2);
  EXPECT_NEAR(ring[1].area(), -M_PI * 8 * 8, 2);
}

TEST(IsoLines, InASaddleTheMeanSaysWhichCornersAreJoined) {
  // The corners above are at the lower left and the upper right, or at the other two.
  for (const bool is_rising : {true, false}) {
    const auto saddle = [&](float high) {
      return is_rising ? std::vector<float>{1, 0, 0, high} : std::vector<float>{0, 1, high, 0};
    };
    for (const bool is_joined : {true, false}) {
      const std::vector<Line> lines = lines_of(saddle(is_joined ? 1 : 0.9f), {2, 2}, is_joined ? 0.4f : 0.5f);
      ASSERT_EQ(lines.size(), 2u);
      for (const Line& line : lines) {
        ASSERT_EQ(line.points.size(), 2u);
        const auto& [a, b] = std::pair(line.points[0], line.points[1]);
        // Each line cuts one corner off. That corner is above, and on the left, unless the corners above are joined.
        const float x = std::round((a[0] + b[0]) / 2), y = std::round((a[1] + b[1]) / 2);
        EXPECT_LE(std::hypot(x - (a[0] + b[0]) / 2, y - (a[1] + b[1]) / 2), 0.5);
        EXPECT_EQ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) > 0, !is_joined);
        EXPECT_EQ((x == y) == is_rising, !is_joined);
      }
    }
  }
}

TEST(IsoLines, CrossEachEdgeOnceAndEndAtTheBorder) {
  test_support::Random random(5);
  const Counts counts{23, 17};
  const float level = 0.5f;
  const std::vector<float> values = sampled(counts, [&](double, double) { return random.number(0, 1); });
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return values[j * counts[0] + i]; };
  std::size_t crossed = 0, points = 0, closed = 0;
  for (std::uint32_t j = 0; j < counts[1]; ++j) {
    for (std::uint32_t i = 0; i < counts[0]; ++i) {
      crossed += i + 1 < counts[0] && (at(i, j) > level) != (at(i + 1, j) > level);
      crossed += j + 1 < counts[1] && (at(i, j) > level) != (at(i, j + 1) > level);
    }
  }
  const auto is_at_border = [&](const std::array<float, 2>& p) {
    return p[0] == 0 || p[1] == 0 || p[0] == counts[0] - 1 || p[1] == counts[1] - 1;
  };
  for (const Line& line : lines_of(values, counts, level)) {
    points += line.points.size();
    closed += line.is_closed();
    if (!line.is_closed()) {
      EXPECT_TRUE(is_at_border(line.points.front()) && is_at_border(line.points.back()));
    }
    for (const auto& [x, y] : line.points) {
      const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
      ASSERT_TRUE(x == i || y == j) << "points lie on edges";
      const float along = x - i + (y - j), a = at(i, j), b = along == 0 ? a : x == i ? at(i, j + 1) : at(i + 1, j);
      EXPECT_NEAR(a + along * (b - a), level, 1e-5);
    }
  }
  EXPECT_EQ(points, crossed + closed) << "a closed line ends with its first point";
  EXPECT_GT(closed, 3u);
}

TEST(IsoLines, ThereIsNoneWhereNothingIsAbove) {
  const std::vector<float> level(12, 0.5f);
  EXPECT_EQ(iso_lines(level, {4, 3}, 0.5f).starts, std::vector<std::uint32_t>{0});
  EXPECT_EQ(iso_lines(level, {4, 3}, 0.25f).starts, std::vector<std::uint32_t>{0});
  // One row of samples has no squares.
  const std::vector<float> row{0, 1, 0, 1};
  EXPECT_EQ(iso_lines(row, {4, 1}, 0.5f).starts, std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace isofield::engine
