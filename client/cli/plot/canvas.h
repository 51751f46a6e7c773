#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/image.h"

namespace isofield {

// Pixels, y downwards; pixel (i, j) covers [i, i + 1] x [j, j + 1].
struct Point {
  double x = 0, y = 0;
};
struct Segment {
  Point a, b;
};
using Color = std::array<std::uint8_t, 3>;

// Anti-aliased lines and text on white.
class Canvas {
 public:
  Canvas(int width, int height);

  // All segments as one stroke: where they meet or cross nothing is drawn twice. Ends are round.
  void stroke(const std::vector<Segment>& segments, double width, Color color);
  // The text's base line begins (align 0), is centred (0.5) or ends (1) at x; digits are `height` high.
  void text(const std::string& text, double x, double y, double height, double align, Color color);
  void fill_pixel(int x, int y, Color color);

  const Image& image() const { return image_; }

 private:
  Image image_;
  std::vector<float> coverage_;  // of the stroke that is drawn
};

}  // namespace isofield
