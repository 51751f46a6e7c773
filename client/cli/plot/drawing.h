#pragma once

#include <cairo.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plot/segment.h"

namespace isofield {

// 0xRRGGBB, as sRGB.
using Color = std::uint32_t;

// Draws lines, text and shades on white. Cairo records them, so that the same drawing can become pixels or a page; see
// plot_file.h. Lengths are in pixels, y downwards; pixel (i, j) covers [i, i + 1] x [j, j + 1]. It is single-threaded.
// Errors of Cairo are kept until status() is asked.
class Drawing {
 public:
  Drawing(int width, int height);

  // Draws all segments as one stroke, so that nothing is drawn twice where they meet or cross. Ends are round.
  void stroke(const std::vector<Segment>& segments, double width, Color color);
  // The text's base line begins (align 0), is centred (0.5) or ends (1) at `at`; digits are `height` high. Bytes that
  // are not UTF-8 are drawn as U+FFFD.
  void text(const std::string& text, const Point& at, double height, double align, Color color);
  double text_width(const std::string& text, double height);
  // Fills the rectangle between two corners with the colours of samples, rows from the top, `columns` a row. The outer
  // samples lie on the rectangle's sides, and each place has the colour of the nearest sample.
  void shade(std::vector<Color> samples, int columns, const Point& low, const Point& high);

  int width() const { return width_; }
  int height() const { return height_; }
  // Returns CAIRO_STATUS_SUCCESS, or the first error of all that was drawn.
  cairo_status_t status() const { return cairo_status(context_.get()); }
  // Returns a recording of all that was drawn so far. The drawing owns it.
  cairo_surface_t* recording() const { return cairo_get_target(context_.get()); }

 private:
  struct Destroy {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  int width_, height_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

}  // namespace isofield
