#include "plot/drawing.h"

#include <algorithm>

#include "utf8.h"

namespace isofield {
namespace {

// Cairo falls back to another font where this one is not installed, and to one of its own where there is none at all.
constexpr char kFont[] = "DejaVu Sans";
// The height of the font's digits as a part of its size.
constexpr double kDigitHeight = 0.729;

void set_color(cairo_t* context, Color color) {
  const auto channel = [&](int shift) { return (color >> shift & 0xff) / 255.0; };
  cairo_set_source_rgb(context, channel(16), channel(8), channel(0));
}

// Turns off the hints of fonts that would round the widths of letters to pixels, so that letters have the same places
// in every format.
void set_font_options(cairo_t* context) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

// Selects the size at which digits are `height` high, and returns the width of the text at that size.
double advance(cairo_t* context, const std::string& text, double height) {
  cairo_set_font_size(context, height / kDigitHeight);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace

Drawing::Drawing(int width, int height) : width_(width), height_(height) {
  const cairo_rectangle_t page{0, 0, static_cast<double>(width), static_cast<double>(height)};
  cairo_surface_t* recording = cairo_recording_surface_create(CAIRO_CONTENT_COLOR, &page);
  context_.reset(cairo_create(recording));
  cairo_surface_destroy(recording);
  cairo_t* context = context_.get();
  set_color(context, 0xffffff);
  cairo_paint(context);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  set_font_options(context);
}

void Drawing::stroke(const std::vector<Segment>& segments, double width, Color color) {
  cairo_t* context = context_.get();
  cairo_new_path(context);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& [a, b] = segments[i];
    if (i == 0 || segments[i - 1].b != a) cairo_move_to(context, a.x, a.y);
    cairo_line_to(context, b.x, b.y);
  }
  set_color(context, color);
  cairo_set_line_width(context, width);
  cairo_stroke(context);
}

void Drawing::text(const std::string& text, const Point& at, double height, double align, Color color) {
  cairo_t* context = context_.get();
  const std::string letters = valid_utf8(text);
  const double width = advance(context, letters, height);
  set_color(context, color);
  cairo_move_to(context, at.x - align * width, at.y);
  cairo_show_text(context, letters.c_str());
}

double Drawing::text_width(const std::string& text, double height) {
  return advance(context_.get(), valid_utf8(text), height);
}

void Drawing::shade(std::vector<Color> samples, int columns, const Point& low, const Point& high) {
  cairo_t* context = context_.get();
  const int rows = static_cast<int>(samples.size()) / columns;
  // Cairo's RGB24 is one number of 32 bits a pixel, whose upper 8 bits are unused.
  cairo_surface_t* image = cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(samples.data()),
                                                               CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
  const Point size = high - low;
  cairo_save(context);
  cairo_rectangle(context, low.x, low.y, size.x, size.y);
  cairo_clip(context);
  // The centre of the first sample lies at `low` and that of the last one at `high`. A single row or column of samples
  // fills the rectangle.
  cairo_translate(context, low.x, low.y);
  cairo_scale(context, size.x / std::max(columns - 1, 1), size.y / std::max(rows - 1, 1));
  cairo_set_source_surface(context, image, columns > 1 ? -0.5 : 0, rows > 1 ? -0.5 : 0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
  // The recording takes a copy of the samples here, before they go.
  cairo_surface_finish(image);
  cairo_surface_destroy(image);
}

}  // namespace isofield
