#include "plot/operator_plot.h"

#include <algorithm>
#include <cmath>

#include "plot/axes.h"
#include "plot/canvas.h"
#include "plot/level_curves.h"

namespace isofield {
namespace {

constexpr Color kLevel{120, 140, 170};
constexpr Color kSurface{20, 50, 110};
constexpr Color kBoundary{214, 84, 30};
constexpr Color kInside{229, 237, 248};
// How far g is from the unblended value where the blend is said to begin.
constexpr float kDeparture = 1e-4f;

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

// How far g has come from the unblended value on the way from the nearer axis: a fold inside the blend, where it comes
// back to it, is no boundary.
std::vector<float> departure_of(const OperatorPlot& plot, const std::vector<float>& g) {
  std::vector<float> departure(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) departure[i] = std::abs(g[i] - plot.unblended[i]);
  const std::size_t side = plot.side;
  for (std::size_t along = 0; along < side; ++along) {
    for (std::size_t i = 1; i <= along; ++i) {
      float& in_row = departure[along * side + i];
      in_row = std::max(in_row, departure[along * side + i - 1]);
      if (i == along) break;  // the diagonal is the row's
      float& in_column = departure[i * side + along];
      in_column = std::max(in_column, departure[(i - 1) * side + along]);
    }
  }
  return departure;
}

void draw_panel(const OperatorPlot& plot, const OperatorPlot::Panel& panel, const Axes& axes, Canvas& canvas) {
  fill_inside(plot, panel.g, axes, canvas);
  const auto [least, most] = std::minmax_element(panel.g.begin(), panel.g.end());
  std::vector<Segment> levels;
  for (auto n = static_cast<long>(std::floor((*least - plot.surface) / plot.step));
       plot.surface + n * plot.step <= *most; ++n) {
    // A level at the very end of the values is an area, not a curve.
    if (n == 0 || plot.surface + n * plot.step <= *least + 1e-6) continue;
    const auto curve = level_curve(panel.g, plot.side, static_cast<float>(plot.surface + n * plot.step));
    levels.insert(levels.end(), curve.begin(), curve.end());
  }
  canvas.stroke(placed(std::move(levels), plot, axes), 1.1, kLevel);
  canvas.stroke(placed(level_curve(panel.g, plot.side, static_cast<float>(plot.surface)), plot, axes), 2.6, kSurface);
  if (!plot.unblended.empty()) {
    canvas.stroke(placed(level_curve(departure_of(plot, panel.g), plot.side, kDeparture), plot, axes), 1.8, kBoundary);
  }
  axes.draw(canvas);
  canvas.text(panel.title, axes.left + axes.width / 2, axes.top - axes.text_height, 1.1 * axes.text_height, 0.5, kInk);
}

}  // namespace

Image draw(const OperatorPlot& plot, int size) {
  const double text = std::clamp(size / 30.0, 7.0, 24.0);
  const double left = 5 * text, right = 1.5 * text, top = 3.5 * text, bottom = 5 * text;
  const auto panels = static_cast<int>(plot.panels.size());
  const auto pitch = static_cast<int>(left + size + right);
  Canvas canvas(panels * pitch, static_cast<int>(top + size + bottom));
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
