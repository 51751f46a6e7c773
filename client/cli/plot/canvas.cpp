#include "plot/canvas.h"

#include <algorithm>
#include <cmath>

#include "plot/stroke_font.h"

namespace isofield {
namespace {

double distance(const Point& p, const Segment& s) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - s.a.x - t * dx, p.y - s.a.y - t * dy);
}

}  // namespace

Canvas::Canvas(int width, int height)
    : image_{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 255)},
      coverage_(std::size_t{1} * width * height) {}

void Canvas::stroke(const std::vector<Segment>& segments, double width, Color color) {
  std::fill(coverage_.begin(), coverage_.end(), 0.0f);
  const double reach = width / 2 + 1;
  for (const Segment& s : segments) {
    const int x0 = std::max(0, static_cast<int>(std::min(s.a.x, s.b.x) - reach));
    const int x1 = std::min(image_.width - 1, static_cast<int>(std::max(s.a.x, s.b.x) + reach));
    const int y0 = std::max(0, static_cast<int>(std::min(s.a.y, s.b.y) - reach));
    const int y1 = std::min(image_.height - 1, static_cast<int>(std::max(s.a.y, s.b.y) + reach));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double cover = width / 2 + 0.5 - distance({x + 0.5, y + 0.5}, s);
        float& c = coverage_[std::size_t{1} * y * image_.width + x];
        c = std::max(c, static_cast<float>(std::clamp(cover, 0.0, 1.0)));
      }
    }
  }
  for (std::size_t pixel = 0; pixel < coverage_.size(); ++pixel) {
    if (coverage_[pixel] == 0) continue;
    for (int channel = 0; channel < 3; ++channel) {
      std::uint8_t& value = image_.rgb[3 * pixel + channel];
      value = static_cast<std::uint8_t>(std::lround(value + coverage_[pixel] * (color[channel] - value)));
    }
  }
}

void Canvas::text(const std::string& text, double x, double y, double height, double align, Color color) {
  stroke(text_strokes(text, x - align * text_width(text, height), y, height), std::max(1.0, height / 7), color);
}

void Canvas::fill_pixel(int x, int y, Color color) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  std::copy(color.begin(), color.end(), &image_.rgb[3 * (std::size_t{1} * y * image_.width + x)]);
}

}  // namespace isofield
