#include "plot/operator_plot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "plot/axes.h"
#include "plot/level_curves.h"

namespace isofield {
namespace {

constexpr Color kLevel = 0x788caa;
constexpr Color kSurface = 0x14326e;
constexpr Color kBoundary = 0xd6541e;
constexpr Color kInside = 0xe5edf8, kOutside = 0xffffff;
// Level curves are too dense if more than kDensePart of one is nearer than kLeastDistance (pixels) to the one before.
constexpr double kLeastDistance = 4, kDensePart = 0.25;

// Converts segments from the samples' coordinates to pixels.
std::vector<Segment> placed(std::vector<Segment> segments, const OperatorPlot& plot, const Axes& axes) {
  const double step = (plot.high - plot.low) / (plot.side - 1);
  for (Segment& s : segments) {
    for (Point* p : {&s.a, &s.b}) *p = axes.place(plot.low + step * p->x, plot.low + step * p->y);
  }
  return segments;
}

// Returns a colour for each sample. The samples' rows begin at the bottom, those of the colours at the top. The stroke
// of the surface hides the steps at the edge of what is inside.
std::vector<Color> shades(const OperatorPlot& plot, const std::vector<float>& g) {
  std::vector<Color> colors;
  colors.reserve(g.size());
  for (int j = plot.side; j-- > 0;) {
    for (int i = 0; i < plot.side; ++i) {
      const float value = g[static_cast<std::size_t>(j) * plot.side + i];
      colors.push_back((value > plot.surface) == plot.inside_above ? kInside : kOutside);
    }
  }
  return colors;
}

Point middle(const Segment& s) {
  return (s.a + s.b) / 2.0;
}

// Returns true if the curve is too dense beside the one before. The curves and `near` are in the samples' coordinates.
bool is_dense(const std::vector<Segment>& curve, const std::vector<Segment>& before, double near) {
  std::size_t dense = 0;
  for (const Segment& s : curve) {
    const Point p = middle(s);
    dense += std::any_of(before.begin(), before.end(),
                         [&](const Segment& other) { return glm::distance(p, middle(other)) < near; });
  }
  return static_cast<double>(dense) > kDensePart * static_cast<double>(curve.size());
}

void draw_panel(const OperatorPlot& plot, const OperatorPlot::Panel& panel, const Axes& axes, Drawing& drawing) {
  drawing.shade(shades(plot, panel.g), plot.side, axes.upper_left(), axes.lower_right());
  std::vector<Segment> levels;
  for (const float level : shown_levels(plot, panel.g, static_cast<int>(axes.width))) {
    const auto curve = level_curve(panel.g, plot.side, level);
    levels.insert(levels.end(), curve.begin(), curve.end());
  }
  drawing.stroke(placed(std::move(levels), plot, axes), 1.1, kLevel);
  drawing.stroke(placed(level_curve(panel.g, plot.side, static_cast<float>(plot.surface)), plot, axes), 2.6, kSurface);
  std::vector<Segment> boundary = panel.boundary;
  for (Segment& s : boundary) s = {axes.place(s.a.x, s.a.y), axes.place(s.b.x, s.b.y)};
  drawing.stroke(boundary, 1.8, kBoundary);
  axes.draw(drawing);
  drawing.text(panel.title, {axes.left + axes.width / 2, axes.top - axes.text_height}, 1.1 * axes.text_height, 0.5,
               kInk);
}

// Returns the text, or the longest beginning of it that is at most `width` pixels wide with "..." after it.
std::string fitted(std::string text, double height, double width, Drawing& drawing) {
  if (drawing.text_width(text, height) <= width) return text;
  while (!text.empty() && drawing.text_width(text + "...", height) > width) {
    const auto is_inner_byte = [](char c) { return (c & 0xc0) == 0x80; };
    while (text.size() > 1 && is_inner_byte(text.back())) text.pop_back();
    text.pop_back();
  }
  return text + "...";
}

}  // namespace

std::vector<float> shown_levels(const OperatorPlot& plot, const std::vector<float>& g, int size) {
  const auto [least, most] = std::minmax_element(g.begin(), g.end());
  const double near = kLeastDistance * (plot.side - 1) / size;
  const auto surface = level_curve(g, plot.side, static_cast<float>(plot.surface));
  std::vector<float> levels;
  for (const int direction : {-1, 1}) {
    auto before = surface;
    // The distance between levels grows as 1, 2, 5, 10, ... steps, because fields may steepen without bound.
    double decade = 1, factor = 1, last = 0;
    while (true) {
      const double next = (std::floor(last / (decade * factor) + 1e-6) + 1) * decade * factor;
      const double level = plot.surface + direction * next * plot.step;
      // A level at the very end of the values is an area, not a curve.
      if (!(level > *least + 1e-6 && level <= *most)) break;
      auto curve = level_curve(g, plot.side, static_cast<float>(level));
      if (!before.empty() && is_dense(curve, before, near)) {
        factor = factor == 1 ? 2 : factor == 2 ? 5 : 1;
        if (factor == 1) decade *= 10;
        continue;
      }
      levels.push_back(static_cast<float>(level));
      if (!curve.empty()) before = std::move(curve);
      last = next;
    }
  }
  return levels;
}

Drawing draw(const OperatorPlot& plot, int size) {
  const double text = std::clamp(size / 30.0, 7.0, 24.0);
  const double heading = plot.heading.empty() ? 0 : 2 * text;
  const double left = 5 * text, right = 1.5 * text, top = 3.5 * text + heading, bottom = 5 * text;
  const auto panels = static_cast<int>(plot.panels.size());
  const auto pitch = static_cast<int>(left + size + right);
  Drawing drawing(panels * pitch, static_cast<int>(top + size + bottom));
  // The heading gets smaller letters, down to a limit, before it is shortened.
  const double room = panels * pitch - 2 * text;
  const double fits = 1.1 * text * room / std::max(1.0, drawing.text_width(plot.heading, 1.1 * text));
  const double height = std::clamp(fits, std::max(0.75 * text, 6.0), 1.1 * text);
  drawing.text(fitted(plot.heading, height, room, drawing), {panels * pitch / 2.0, 2.5 * text}, height, 0.5, kInk);
  std::vector<double> ticks;
  for (const double part : {0.0, 0.5, 1.0}) ticks.push_back(plot.low + part * (plot.high - plot.low));
  // Zero is a tick if it is in the range.
  if (plot.low < 0) ticks = {plot.low, 0, plot.high / 2, plot.high};
  for (int i = 0; i < panels; ++i) {
    const Axes axes{std::floor(i * pitch + left) + 0.5,
                    std::floor(top) + 0.5,
                    double(size),
                    double(size),
                    plot.low,
                    plot.high,
                    plot.low,
                    plot.high,
                    ticks,
                    ticks,
                    plot.x_name,
                    plot.y_name,
                    text};
    draw_panel(plot, plot.panels[i], axes, drawing);
  }
  return drawing;
}

}  // namespace isofield
