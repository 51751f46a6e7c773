#include "plot/slice_plot.h"

#include <absl/strings/str_format.h>

#include <algorithm>
#include <cmath>

#include "plot/axes.h"

namespace isofield {
namespace {

constexpr Color kLevel = 0x5a6e91;
constexpr Color kSurface = 0x14326e;
// The colours of the least and of the greatest value: red, green, blue.
constexpr int kLow[] = {255, 255, 255}, kHigh[] = {150, 185, 225};

// Returns a colour for each value. The values' rows begin at the bottom, those of the colours at the top.
std::vector<Color> shades(const Slice& slice, float least, float most) {
  const double range = std::max(double{most} - least, 1e-30);
  const std::size_t columns = slice.counts[0], rows = slice.counts[1];
  std::vector<Color> colors;
  colors.reserve(slice.values.size());
  for (std::size_t row = rows; row-- > 0;) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double part = (slice.values[row * columns + column] - least) / range;
      Color color = 0;
      for (int c = 0; c < 3; ++c) {
        color = color << 8 | static_cast<Color>(std::lround(kLow[c] + part * (kHigh[c] - kLow[c])));
      }
      colors.push_back(color);
    }
  }
  return colors;
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

// Returns about four ticks within [0, high], at multiples of 1, 2 or 5 times a power of ten.
std::vector<double> ticks_to(double high) {
  const double rough = high / 4, decade = std::pow(10, std::floor(std::log10(rough)));
  const double step = decade * (rough < 2 * decade ? 1 : rough < 5 * decade ? 2 : 5);
  std::vector<double> ticks;
  for (int n = 0; n * step <= high * (1 + 1e-9); ++n) ticks.push_back(n * step);
  return ticks;
}

}  // namespace

Drawing draw(const Slice& slice, const std::array<double, 2>& spacing, const std::string& heading, int size) {
  const double text = std::clamp(size / 45.0, 7.0, 24.0);
  const double left = 6 * text, right = 2 * text, top = 4.5 * text, bottom = 5 * text;
  // A single row or column of samples is drawn as wide as the spacing.
  const double across = spacing[0] * std::max<double>(static_cast<double>(slice.counts[0]) - 1, 1);
  const double up = spacing[1] * std::max<double>(static_cast<double>(slice.counts[1]) - 1, 1);
  const double scale = size / std::max(across, up);
  const double width = std::max(std::floor(across * scale), 1.0), height = std::max(std::floor(up * scale), 1.0);
  Drawing drawing(static_cast<int>(left + width + right), static_cast<int>(top + height + bottom));
  const Axes axes{std::floor(left) + 0.5, std::floor(top) + 0.5, width, height, 0,   across, 0, up,
                  ticks_to(across),       ticks_to(up),          "u",   "v",    text};
  const auto [least, most] = std::minmax_element(slice.values.begin(), slice.values.end());
  drawing.shade(shades(slice, *least, *most), static_cast<int>(slice.counts[0]), axes.upper_left(), axes.lower_right());
  std::vector<Segment> others;
  for (std::size_t n = 1; n < slice.curves.size(); ++n) {
    const auto segments = segments_of(slice.curves[n], axes);
    others.insert(others.end(), segments.begin(), segments.end());
  }
  drawing.stroke(others, 1.1, kLevel);
  if (!slice.curves.empty()) drawing.stroke(segments_of(slice.curves[0], axes), 2.6, kSurface);
  axes.draw(drawing);
  drawing.text(absl::StrFormat("%s: %.4g to %.4g", heading, *least, *most), {axes.left + width / 2, 2 * text}, text,
               0.5, kInk);
  return drawing;
}

}  // namespace isofield
