#pragma once

#include <string>
#include <vector>

#include "plot/drawing.h"

namespace isofield {

inline constexpr Color kInk = 0x191e28;

// The frame of a plot: where it lies on the drawing, and the range, ticks and name of each axis.
struct Axes {
  double left = 0, top = 0, width = 0, height = 0;  // pixels
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
  std::vector<double> x_ticks, y_ticks;
  std::string x_name, y_name;
  double text_height = 9;  // pixels

  // Converts a point on the axes to pixels.
  Point place(double x, double y) const {
    return {left + width * (x - x_low) / (x_high - x_low), top + height * (y_high - y) / (y_high - y_low)};
  }
  // The frame's corners in pixels.
  Point upper_left() const { return {left, top}; }
  Point lower_right() const { return {left + width, top + height}; }
  // Draws the frame, the tick marks with their numbers, and the names.
  void draw(Drawing& drawing) const;
};

}  // namespace isofield
