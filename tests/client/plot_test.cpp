#include <gtest/gtest.h>

#include <cmath>

#include "plot/canvas.h"
#include "plot/level_curves.h"
#include "plot/operator_plot.h"
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
  plot.unblended = panel.g;
  plot.panels = {panel, panel, panel};
  const Image image = draw(plot, 120);
  EXPECT_EQ(image.width % 3, 0);
  EXPECT_GT(image.width, 3 * 120);
  EXPECT_EQ(image.rgb.size(), std::size_t{3} * image.width * image.height);
  plot.panels = {panel};
  EXPECT_EQ(draw(plot, 120).width, image.width / 3);
  plot.low = -1;
  plot.high = 2;
  plot.surface = 0;
  std::fill(plot.panels[0].g.begin(), plot.panels[0].g.end(), 0.0f);
  EXPECT_EQ(draw(plot, 120).width, image.width / 3) << "a constant operator has no curves";
}

}  // namespace
}  // namespace isofield
