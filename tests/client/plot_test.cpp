#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "isofield/scene_file.h"
#include "plot/drawing.h"
#include "plot/level_curves.h"
#include "plot/operator_plot.h"
#include "plot/plot_file.h"
#include "plot/region_outline.h"
#include "test_support.h"

namespace isofield {
namespace {

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
  // Barthe's lines go straight down to the corner and have no hooks there.
  const auto wedge = region_outline(0, 1, 64, where([](const Point& p) { return p.y > 0.3 * p.x && p.x > 0.3 * p.y; }));
  ASSERT_TRUE(wedge.ok()) << wedge.status();
  double length = 0;
  for (const Segment& s : *wedge) {
    for (const Point& p : {s.a, s.b}) {
      const double off = std::min(std::abs(p.y - 0.3 * p.x), std::abs(p.x - 0.3 * p.y));
      EXPECT_LT(off, 1e-3) << p.x << " " << p.y;
    }
    length += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
  }
  EXPECT_NEAR(length, 2 * std::hypot(1, 0.3), 0.05) << "both sides, from the corner to the frame";
  // The region is all of the square but the axes themselves.
  const auto open = region_outline(0, 1, 64, where([](const Point& p) { return p.x > 0 && p.y > 0; }));
  ASSERT_TRUE(open.ok()) << open.status();
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
  // The function steepens like the super-elliptic blend with a great exponent: 1e19 steps of levels.
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

// The pixels of a drawing.
struct Pixels {
  explicit Pixels(const Drawing& drawing)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, drawing.width(), drawing.height())) {
    cairo_t* context = cairo_create(surface);
    cairo_set_source_surface(context, drawing.recording(), 0, 0);
    cairo_paint(context);
    cairo_destroy(context);
    cairo_surface_flush(surface);
  }
  ~Pixels() { cairo_surface_destroy(surface); }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  Color at(int x, int y) const {
    const unsigned char* row = cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface);
    return reinterpret_cast<const Color*>(row)[x] & 0xffffff;
  }
  int darkness(int x, int y) const { return 255 - static_cast<int>(at(x, y) & 0xff); }
  // Returns the ink of all pixels of some columns, in whole pixels.
  double ink(int first, int last) const {
    double sum = 0;
    for (int y = 0; y < cairo_image_surface_get_height(surface); ++y) {
      for (int x = first; x < last; ++x) sum += darkness(x, y) / 255.0;
    }
    return sum;
  }

  cairo_surface_t* surface;
};

TEST(Drawing, StrokesCoverTheirWidth) {
  Drawing drawing(40, 20);
  // The same segment twice makes one stroke.
  drawing.stroke({{{5, 10}, {35, 10}}, {{5, 10}, {35, 10}}}, 3, 0);
  const Pixels pixels(drawing);
  EXPECT_NEAR(pixels.ink(20, 21), 3, 0.05);
  EXPECT_EQ(pixels.darkness(20, 10), 255);
  EXPECT_EQ(pixels.darkness(38, 10), 0);
  // Nothing is written beyond the drawing.
  drawing.stroke({{{-50, -50}, {90, 90}}}, 5, 0);
  EXPECT_EQ(drawing.status(), CAIRO_STATUS_SUCCESS);
}

TEST(Drawing, PlacesText) {
  for (const double align : {0.0, 0.5, 1.0}) {
    Drawing drawing(100, 40);
    drawing.text("008", {50, 30}, 14, align, 0);
    const double width = drawing.text_width("008", 14), left = 50 - align * width;
    EXPECT_GT(width, 14);
    EXPECT_LT(width, 42);
    const Pixels pixels(drawing);
    EXPECT_GT(pixels.ink(0, 100), 30);
    EXPECT_EQ(pixels.ink(0, static_cast<int>(left) - 1), 0) << align;
    EXPECT_EQ(pixels.ink(static_cast<int>(left + width) + 2, 100), 0) << align;
  }
}

TEST(Drawing, TakesTextThatIsNotUtf8) {
  Drawing drawing(100, 40);
  drawing.text("neur\xf3n \xce\xb8", {5, 30}, 14, 0, 0);
  EXPECT_EQ(drawing.status(), CAIRO_STATUS_SUCCESS);
  EXPECT_GT(drawing.text_width("\xf3", 14), 0);
  EXPECT_GT(Pixels(drawing).ink(0, 100), 30);
}

TEST(Drawing, ShadesWithTheNearestSample) {
  Drawing drawing(60, 60);
  // The picture has two rows of three samples. The outer samples lie on the sides, so their cells are cut in half.
  drawing.shade({0x000001, 0x000002, 0x000003, 0x000004, 0x000005, 0x000006}, 3, {10, 10}, {50, 30});
  const Pixels pixels(drawing);
  EXPECT_EQ(pixels.at(9, 12), 0xffffffu);
  EXPECT_EQ(pixels.at(10, 10), 1u);
  EXPECT_EQ(pixels.at(19, 10), 1u);
  EXPECT_EQ(pixels.at(20, 10), 2u);
  EXPECT_EQ(pixels.at(39, 19), 2u);
  EXPECT_EQ(pixels.at(49, 19), 3u);
  EXPECT_EQ(pixels.at(49, 20), 6u);
  EXPECT_EQ(pixels.at(10, 29), 4u);
  EXPECT_EQ(pixels.at(10, 30), 0xffffffu);
  // A single column of samples fills the rectangle.
  drawing.shade({0x000007, 0x000008}, 1, {0, 40}, {60, 60});
  EXPECT_EQ(Pixels(drawing).at(0, 40), 7u);
  EXPECT_EQ(Pixels(drawing).at(59, 59), 8u);
}

Drawing small_drawing(int width) {
  Drawing drawing(width, 40);
  drawing.shade({0x336699, 0xffffff}, 2, {10, 10}, {20, 20});
  drawing.stroke({{{5, 10}, {35, 10}}}, 3, 0);
  drawing.text("theta = 22.5", {5, 30}, 14, 0, 0);
  return drawing;
}

std::string written(const Drawing& drawing, const std::string& path) {
  auto file = OutputFile::create(path);
  EXPECT_TRUE(file.ok()) << file.status();
  absl::Status status = write_plot(drawing, plot_format(path).value(), **file);
  if (status.ok()) status = (*file)->commit();
  return status.ok() ? *read_file(path) : status.ToString();
}

TEST(PlotFile, WritesEachFormat) {
  const TemporaryDirectory directory;
  for (const auto& [ending, start] : {std::pair("png", "\x89PNG"), {"svg", "<?xml"}, {"PDF", "%PDF-"}}) {
    const std::string bytes = written(small_drawing(150), directory.path(absl::StrCat("a.", ending)));
    EXPECT_EQ(bytes.substr(0, std::strlen(start)), start) << ending;
    EXPECT_FALSE(absl::StrContains(bytes, "CreationDate")) << "which would differ from second to second";
    // The ids of an SVG go on counting in the same process, so two SVG files differ.
    if (absl::string_view(ending) == "svg") continue;
    EXPECT_EQ(written(small_drawing(150), directory.path(absl::StrCat("b.", ending))), bytes) << ending;
  }
  EXPECT_EQ(plot_format("a.jpg"), std::nullopt);
}

TEST(PlotFile, KeepsThePlotsSize) {
  const TemporaryDirectory directory;
  EXPECT_TRUE(absl::StrContains(written(small_drawing(150), directory.path("a.svg")), "width=\"150px\""));
  // The size is in points, of which an inch has 72.
  EXPECT_TRUE(absl::StrContains(written(small_drawing(150), directory.path("a.pdf")), "0 0 112.5 30"));
}

TEST(PlotFile, RefusesAPngThatCairoCannotMake) {
  const TemporaryDirectory directory;
  EXPECT_TRUE(absl::StrContains(written(small_drawing(32768), directory.path("a.png")), "expected a smaller --size"));
  EXPECT_TRUE(absl::StrContains(written(small_drawing(32768), directory.path("a.svg")), "width=\"32768px\""));
}

TEST(OperatorPlot, DrawsAPanelForEachAngle) {
  OperatorPlot plot{.x_name = "f1", .y_name = "f2", .side = 65};
  OperatorPlot::Panel panel{"max", {}};
  for (int j = 0; j < plot.side; ++j) {
    for (int i = 0; i < plot.side; ++i) panel.g.push_back(std::max(i, j) / 64.0f);
  }
  panel.boundary = {{{0, 0}, {1, 0.5}}};
  plot.panels = {panel, panel, panel};
  const Drawing drawing = draw(plot, 120);
  EXPECT_EQ(drawing.status(), CAIRO_STATUS_SUCCESS);
  EXPECT_EQ(drawing.width() % 3, 0);
  EXPECT_GT(drawing.width(), 3 * 120);
  plot.panels = {panel};
  EXPECT_EQ(draw(plot, 120).width(), drawing.width() / 3);
  plot.heading = std::string(400, 'a');
  EXPECT_GT(draw(plot, 120).height(), drawing.height()) << "above the panels";
  EXPECT_EQ(draw(plot, 120).width(), drawing.width() / 3) << "and shortened";
  plot.low = -1;
  plot.high = 2;
  plot.surface = 0;
  std::fill(plot.panels[0].g.begin(), plot.panels[0].g.end(), 0.0f);
  EXPECT_EQ(draw(plot, 120).width(), drawing.width() / 3) << "a constant operator has no curves";
}

}  // namespace
}  // namespace isofield
