#include "plot/operator_plot.h"

#include <algorithm>
#include <cmath>

#include "plot/axes.h"
#include "plot/canvas.h"
#include "plot/level_curves.h"
#include "plot/stroke_font.h"

namespace isofield {
namespace {

constexpr Color kLevel{120, 140, 170};
constexpr Color kSurface{20, 50, 110};
constexpr Color kBoundary{214, 84, 30};
constexpr Color kInside{229, 237, 248};
// Level curves nearer than this to each other, in pixels, are too dense, if more than that part of a curve is.
constexpr double kLeastDistance = 4, kDensePart = 0.25;

// From grid coordinates to pixels.
std::vector<Segment> placed(std::vector<Segment> segments, const OperatorPlot& plot, const Axes& axes) {
  const double step = (plot.high - plot.low) / (plot.side - 1);
  for (Segment& s : segments) {
    for (Point* p : {&s.a, &s.b}) *p = axes.place(plot.low + step * p->x, plot.low + step * p->y);
  }
  return segments;
}

void fill_inside(const OperatorPlot& plot, const std::vector<float>& g, const Axes& axes, Canvas& canvas) {
  const auto size = static_cast<int>(axes.width);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      // The nearest sample is near enough: the edge lies below the surface's stroke.
      const auto i = std::lround((x + 0.5) / size * (plot.side - 1));
      const auto j = std::lround((1 - (y + 0.5) / size) * (plot.side - 1));
      const float value = g[static_cast<std::size_t>(j * plot.side + i)];
      if ((value > plot.surface) == plot.inside_above) {
        canvas.fill_pixel(static_cast<int>(axes.left) + x, static_cast<int>(axes.top) + y, kInside);
      }
    }
  }
}

Point middle(const Segment& s) {
  return {(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2};
}

// Both curves in the samples' coordinates; `near`: in those too.
bool is_dense(const std::vector<Segment>& curve, const std::vector<Segment>& before, double near) {
  std::size_t dense = 0;
  for (const Segment& s : curve) {
    const Point p = middle(s);
    dense += std::any_of(before.begin(), before.end(), [&](const Segment& other) {
      const Point q = middle(other);
      return std::hypot(p.x - q.x, p.y - q.y) < near;
    });
  }
  return static_cast<double>(dense) > kDensePart * static_cast<double>(curve.size());
}

void draw_panel(const OperatorPlot& plot, const OperatorPlot::Panel& panel, const Axes& axes, Canvas& canvas) {
  fill_inside(plot, panel.g, axes, canvas);
  std::vector<Segment> levels;
  for (const float level : shown_levels(plot, panel.g, static_cast<int>(axes.width))) {
    const auto curve = level_curve(panel.g, plot.side, level);
    levels.insert(levels.end(), curve.begin(), curve.end());
  }
  canvas.stroke(placed(std::move(levels), plot, axes), 1.1, kLevel);
  canvas.stroke(placed(level_curve(panel.g, plot.side, static_cast<float>(plot.surface)), plot, axes), 2.6, kSurface);
  std::vector<Segment> boundary = panel.boundary;
  for (Segment& s : boundary) s = {axes.place(s.a.x, s.a.y), axes.place(s.b.x, s.b.y)};
  canvas.stroke(boundary, 1.8, kBoundary);
  axes.draw(canvas);
  canvas.text(panel.title, axes.left + axes.width / 2, axes.top - axes.text_height, 1.1 * axes.text_height, 0.5, kInk);
}

// The beginning of a text that is at most so wide.
std::string fitted(std::string text, double height, double width) {
  if (text_width(text, height) <= width) return text;
  while (!text.empty() && text_width(text + "...", height) > width) text.pop_back();
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
    // How many steps are left out grows as 1, 2, 5, 10, ...: fields may steepen without bound.
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

Image draw(const OperatorPlot& plot, int size) {
  const double text = std::clamp(size / 30.0, 7.0, 24.0);
  const double heading = plot.heading.empty() ? 0 : 2 * text;
  const double left = 5 * text, right = 1.5 * text, top = 3.5 * text + heading, bottom = 5 * text;
  const auto panels = static_cast<int>(plot.panels.size());
  const auto pitch = static_cast<int>(left + size + right);
  Canvas canvas(panels * pitch, static_cast<int>(top + size + bottom));
  // In smaller letters before it is shortened.
  const double room = panels * pitch - 2 * text;
  const double fits = 1.1 * text * room / std::max(1.0, text_width(plot.heading, 1.1 * text));
  const double height = std::clamp(fits, std::max(0.75 * text, 6.0), 1.1 * text);
  canvas.text(fitted(plot.heading, height, room), panels * pitch / 2.0, 2.5 * text, height, 0.5, kInk);
  std::vector<double> ticks;
  for (const double part : {0.0, 0.5, 1.0}) ticks.push_back(plot.low + part * (plot.high - plot.low));
  // Zero belongs among them.
  if (plot.low < 0) ticks = {plot.low, 0, plot.high / 2, plot.high};
  for (int i = 0; i < panels; ++i) {
    const Axes axes{std::floor(i * pitch + left),
                    std::floor(top),
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
    draw_panel(plot, plot.panels[i], axes, canvas);
  }
  return canvas.image();
}

}  // namespace isofield
