#include "plot/axes.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

namespace isofield {

void Axes::draw(Drawing& drawing) const {
  const Point low = place(x_low, y_low), high = place(x_high, y_high);
  std::vector<Segment> lines{
      {low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
  const double tick = 0.5 * text_height;
  for (const double x : x_ticks) {
    const Point at = place(x, y_low);
    lines.push_back({at, {at.x, at.y + tick}});
    drawing.text(absl::StrCat(x), {at.x, at.y + tick + 1.7 * text_height}, text_height, 0.5, kInk);
  }
  for (const double y : y_ticks) {
    const Point at = place(x_low, y);
    lines.push_back({at, {at.x - tick, at.y}});
    drawing.text(absl::StrCat(y), {at.x - 1.6 * tick, at.y + 0.5 * text_height}, text_height, 1, kInk);
  }
  drawing.stroke(lines, 1, kInk);
  drawing.text(x_name, {high.x, low.y + tick + 3.6 * text_height}, text_height, 1, kInk);
  const double start = low.x - 1.6 * tick - drawing.text_width(y_name, text_height) / 2;
  drawing.text(y_name, {std::max(start, 0.5 * text_height), high.y - 1.2 * text_height}, text_height, 0, kInk);
}

}  // namespace isofield
