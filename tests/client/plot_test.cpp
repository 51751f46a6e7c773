#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "plot/canvas.h"
#include "plot/level_curves.h"
#include "plot/operator_plot.h"
#include "plot/region_outline.h"
#include "plot/stroke_font.h"

namespace isofield {
namespace {

int darkness(const Image& image, int x, int y) {
  return 255 - image.rgb[3 * (std::size_t{1} * y * image.width + x)];
}

TEST(LevelCurves, FollowACircle) {
  constexpr int kSide = 101;
  std::vector<float> values;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) values.push_back(std::hypot(i - 50.0f, j - 50.0f));
  }
  double length = 0;
  for (const Segment& s : level_curve(values, kSide, 30.25f)) {
    for (const Point& p : {s.a, s.b}) EXPECT_NEAR(std::hypot(p.x - 50, p.y - 50), 30.25, 0.01);
    length += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
  }
  EXPECT_NEAR(length, 2 * M_PI * 30.25, 0.1) << "closed, and nothing twice";
  EXPECT_TRUE(level_curve(values, kSide, 100).empty());
}

Membership where(const std::function<bool(const Point&)>& contains) {
  return [contains](const std::vector<Point>& points) {
    std::vector<char> inside;
    for (const Point& p : points) inside.push_back(contains(p));
    return inside;
  };
}

TEST(RegionOutline, LiesWhereTheRegionEnds) {
  const auto outline =
      region_outline(-1, 2, 60, where([](const Point& p) { return std::hypot(p.x - 0.3, p.y - 0.4) < 0.9; }));
  ASSERT_TRUE(outline.ok()) << outline.status();
  double length = 0;
  for (const Segment& s : *outline) {
    for (const Point& p : {s.a, s.b}) EXPECT_NEAR(std::hypot(p.x - 0.3, p.y - 0.4), 0.9, 0.05 / 1000);
    length += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
  }
  EXPECT_NEAR(length, 2 * M_PI * 0.9, 0.01) << "closed";
}

TEST(RegionOutline, ReachesAWedgeAndASideOfTheFrame) {
  // Barthe's lines: straight down to the corner, and no hooks there.
  const auto wedge = region_outline(0, 1, 64, where([](const Point& p) { return p.y > 0.3 * p.x && p.x > 0.3 * p.y; }));
  for (const Segment& s : *wedge) {
    for (const Point& p : {s.a, s.b}) {
      const double off = std::min(std::abs(p.y - 0.3 * p.x), std::abs(p.x - 0.3 * p.y));
      EXPECT_LT(off, 1e-3) << p.x << " " << p.y;
    }
  }
  // All but the axes themselves.
  const auto open = region_outline(0, 1, 64, where([](const Point& p) { return p.x > 0 && p.y > 0; }));
  EXPECT_GE(open->size(), 2u * 63);
  for (const Segment& s : *open) EXPECT_LT(std::min(s.a.x, s.a.y), 1e-4);
}

TEST(RegionOutline, LeavesSinglePointsOutAndPassesErrorsOn) {
  EXPECT_TRUE(region_outline(0, 1, 64, where([](const Point& p) { return p.x == p.y; }))->empty());
  EXPECT_TRUE(region_outline(0, 1, 64, where([](const Point&) { return true; }))->empty());
  const auto refused = region_outline(0, 1, 64, [](const std::vector<Point>&) -> absl::StatusOr<std::vector<char>> {
    return absl::UnavailableError("gone");
  });
  EXPECT_EQ(refused.status().message(), "gone");
}

std::vector<float> levels_of(OperatorPlot plot, const std::function<double(double)>& g) {
  plot.side = 181;
  std::vector<float> samples;
  for (int j = 0; j < plot.side; ++j) {
    for (int i = 0; i < plot.side; ++i) {
      samples.push_back(static_cast<float>(g(plot.low + (plot.high - plot.low) * i / (plot.side - 1))));
    }
  }
  return shown_levels(plot, samples, 360);
}

TEST(OperatorPlot, ShowsLevelsAtItsStepWhereTheyAreFarApart) {
  const auto levels = levels_of({}, [](double x) { return x; });
  ASSERT_EQ(levels.size(), 9u) << "0.1 to 1 but the surface; 0 is the very end";
  EXPECT_FLOAT_EQ(levels[0], 0.4f);
  EXPECT_FLOAT_EQ(levels[4], 0.6f);
  EXPECT_TRUE(levels_of({}, [](double) { return 1; }).empty());
}

TEST(OperatorPlot, SkipsLevelsThatWouldRunTogether) {
  // Steepens like the super-elliptic blend with a great exponent: 1e19 steps.
  OperatorPlot plot{.low = -1, .high = 2, .surface = 0, .inside_above = false};
  const auto levels = levels_of(plot, [](double x) { return 1 - std::pow(std::max(0.0, 1 - x), 64); });
  ASSERT_GT(levels.size(), 10u);
  EXPECT_LT(levels.size(), 100u);
  double last = 1e9;
  for (const float level : levels) {
    if (level > 0) break;
    const double x = 360 * (1 - std::pow(1 - level, 1.0 / 64)) / 3;
    EXPECT_LT(x, last - 3.5) << level;
    EXPECT_NEAR(std::remainder(level, 0.1), 0, std::abs(level) * 1e-6);
    last = x;
  }
}

TEST(Canvas, StrokesCoverTheirWidth) {
  Canvas canvas(40, 20);
  // Twice the same segment is one stroke.
  canvas.stroke({{{5, 10}, {35, 10}}, {{5, 10}, {35, 10}}}, 3, {0, 0, 0});
  double ink = 0;
  for (int y = 0; y < 20; ++y) ink += darkness(canvas.image(), 20, y);
  EXPECT_NEAR(ink / 255, 3, 0.05);
  EXPECT_EQ(darkness(canvas.image(), 20, 10), 255);
  EXPECT_EQ(darkness(canvas.image(), 38, 10), 0);
  // Beyond the canvas nothing is written.
  canvas.stroke({{{-50, -50}, {90, 90}}}, 5, {0, 0, 0});
}

TEST(StrokeFont, HasDigitsLettersAndSigns) {
  for (const char c : std::string("0123456789abcdefghijklmnopqrstuvwxyzABZ.,:-+=()/_")) {
    EXPECT_FALSE(text_strokes(std::string(1, c), 0, 0, 6).empty()) << c;
  }
  EXPECT_TRUE(text_strokes(" ", 0, 0, 6).empty());
  for (const Segment& s : text_strokes("8", 10, 20, 6)) {
    for (const Point& p : {s.a, s.b}) {
      EXPECT_TRUE(p.x >= 10 && p.x <= 10 + text_width("8", 6) && p.y <= 20 && p.y >= 14) << p.x << " " << p.y;
    }
  }
}

TEST(OperatorPlot, DrawsAPanelForEachAngle) {
  OperatorPlot plot{.x_name = "f1", .y_name = "f2", .side = 65};
  OperatorPlot::Panel panel{"max", {}};
  for (int j = 0; j < plot.side; ++j) {
    for (int i = 0; i < plot.side; ++i) panel.g.push_back(std::max(i, j) / 64.0f);
  }
  panel.boundary = {{{0, 0}, {1, 0.5}}};
  plot.panels = {panel, panel, panel};
  const Image image = draw(plot, 120);
  EXPECT_EQ(image.width % 3, 0);
  EXPECT_GT(image.width, 3 * 120);
  EXPECT_EQ(image.rgb.size(), std::size_t{3} * image.width * image.height);
  plot.panels = {panel};
  EXPECT_EQ(draw(plot, 120).width, image.width / 3);
  plot.heading = std::string(400, 'a');
  EXPECT_GT(draw(plot, 120).height, image.height) << "above the panels";
  EXPECT_EQ(draw(plot, 120).width, image.width / 3) << "and shortened";
  plot.low = -1;
  plot.high = 2;
  plot.surface = 0;
  std::fill(plot.panels[0].g.begin(), plot.panels[0].g.end(), 0.0f);
  EXPECT_EQ(draw(plot, 120).width, image.width / 3) << "a constant operator has no curves";
}

}  // namespace
}  // namespace isofield
