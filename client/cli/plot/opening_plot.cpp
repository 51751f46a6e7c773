#include "plot/opening_plot.h"

#include <algorithm>
#include <cmath>

#include "plot/axes.h"

namespace isofield {
namespace {

constexpr Color kColors[] = {0x1450aa, 0xd6541e, 0x1e8c50};
constexpr Color kGrid = 0xdee2e8;

}  // namespace

Drawing draw(const std::vector<OpeningCurve>& curves, int size) {
  const double text = std::clamp(size / 30.0, 7.0, 24.0);
  const double left = 5 * text, right = 3 * text, top = 5.5 * text, bottom = 5 * text;
  Drawing drawing(static_cast<int>(left + 2 * size + right), static_cast<int>(top + size + bottom));
  const Axes axes{std::floor(left) + 0.5, std::floor(top) + 0.5, 2.0 * size,    1.0 * size,    0,   180, 0, 45,
                  {0, 45, 90, 135, 180},  {0, 15, 30, 45},       "alpha (deg)", "theta (deg)", text};
  std::vector<Segment> grid;
  for (const double x : axes.x_ticks) grid.push_back({axes.place(x, 0), axes.place(x, 45)});
  for (const double y : axes.y_ticks) grid.push_back({axes.place(0, y), axes.place(180, y)});
  drawing.stroke(grid, 1, kGrid);
  axes.draw(drawing);
  double legend = left + 2.0 * size;
  for (std::size_t i = curves.size(); i-- > 0;) {
    const OpeningCurve& curve = curves[i];
    const Color color = kColors[i % std::size(kColors)];
    std::vector<Segment> segments;
    const double step = 180.0 / static_cast<double>(curve.theta.size() - 1);
    for (std::size_t at = 1; at < curve.theta.size(); ++at) {
      segments.push_back({axes.place(step * static_cast<double>(at - 1), curve.theta[at - 1]),
                          axes.place(step * static_cast<double>(at), curve.theta[at])});
    }
    drawing.stroke(segments, 2.2, color);
    // The legend is drawn from right to left. A sample of the line stands before each name.
    const double y = top - 3 * text;
    drawing.text(curve.name, {legend, y}, 1.1 * text, 1, kInk);
    legend -= drawing.text_width(curve.name, 1.1 * text) + text;
    drawing.stroke({{{legend - 2.5 * text, y - 0.5 * text}, {legend, y - 0.5 * text}}}, 2.2, color);
    legend -= 5 * text;
  }
  return drawing;
}

}  // namespace isofield
