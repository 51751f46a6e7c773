#include "plot/slice_plot.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>

#include "plot/axes.h"
#include "plot/canvas.h"

namespace isofield {
namespace {

constexpr Color kLevel{90, 110, 145};
constexpr Color kSurface{20, 50, 110};
constexpr std::array<double, 3> kLow{255, 255, 255}, kHigh{150, 185, 225};

void fill(const Slice& slice, const Axes& axes, Canvas& canvas) {
  const auto [least, most] = std::minmax_element(slice.values.begin(), slice.values.end());
  const double range = std::max(double{*most} - *least, 1e-30);
  const auto width = static_cast<int>(axes.width), height = static_cast<int>(axes.height);
  const auto columns = static_cast<double>(slice.counts[0] - 1), rows = static_cast<double>(slice.counts[1] - 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(std::lround((x + 0.5) / width * columns));
      const auto j = static_cast<std::size_t>(std::lround((1 - (y + 0.5) / height) * rows));
      const double part = (slice.values[j * slice.counts[0] + i] - *least) / range;
      Color color;
      for (int c = 0; c < 3; ++c)
        color[c] = static_cast<std::uint8_t>(std::lround(kLow[c] + part * (kHigh[c] - kLow[c])));
      canvas.fill_pixel(static_cast<int>(axes.left) + x, static_cast<int>(axes.top) + y, color);
    }
  }
}

std::vector<Segment> segments_of(const LevelCurves& curves, const Axes& axes) {
  std::vector<Segment> segments;
  for (std::size_t line = 0; line + 1 < curves.starts.size(); ++line) {
    for (std::uint32_t n = curves.starts[line]; n + 1 < curves.starts[line + 1]; ++n) {
      const float* p = &curves.points[2 * std::size_t{n}];
      segments.push_back({axes.place(p[0], p[1]), axes.place(p[2], p[3])});
    }
  }
  return segments;
}

// Multiples of 1, 2 or 5 times a power of ten, about four of them.
std::vector<double> ticks_to(double high) {
  const double rough = high / 4, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough < 2 * decade ? 1 : rough < 5 * decade ? 2 : 5);
  std::vector<double> ticks;
  for (int n = 0; n * step <= high * (1 + 1e-9); ++n) ticks.push_back(n * step);
  return ticks;
}

}  // namespace

Image draw(const Slice& slice, const std::array<double, 2>& spacing, const std::string& heading, int size) {
  const double text = std::clamp(size / 45.0, 7.0, 24.0);
  const double left = 6 * text, right = 2 * text, top = 4.5 * text, bottom = 5 * text;
  // A single row of samples is drawn as wide as it is apart from the next.
  const double across = spacing[0] * std::max<double>(static_cast<double>(slice.counts[0]) - 1, 1);
  const double up = spacing[1] * std::max<double>(static_cast<double>(slice.counts[1]) - 1, 1);
  const double scale = size / std::max(across, up);
  const double width = std::max(std::floor(across * scale), 1.0), height = std::max(std::floor(up * scale), 1.0);
  Canvas canvas(static_cast<int>(left + width + right), static_cast<int>(top + height + bottom));
  const Axes axes{std::floor(left), std::floor(top), width, height, 0,   across, 0, up,
                  ticks_to(across), ticks_to(up),    "u",   "v",    text};
  fill(slice, axes, canvas);
  std::vector<Segment> others;
  for (std::size_t n = 1; n < slice.curves.size(); ++n) {
    const auto segments = segments_of(slice.curves[n], axes);
    others.insert(others.end(), segments.begin(), segments.end());
  }
  canvas.stroke(others, 1.1, kLevel);
  if (!slice.curves.empty()) canvas.stroke(segments_of(slice.curves[0], axes), 2.6, kSurface);
  axes.draw(canvas);
  const auto [least, most] = std::minmax_element(slice.values.begin(), slice.values.end());
  canvas.text(absl::StrFormat("%s: %.4g to %.4g", heading, *least, *most), axes.left + width / 2, 2 * text, text, 0.5,
              kInk);
  return canvas.image();
}

}  // namespace isofield
