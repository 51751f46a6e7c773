#include "plot/plot_file.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <memory>

namespace isofield {
namespace {

// Cairo's own limit on the sides of an image.
constexpr int kMostPixels = 32767;
constexpr double kPointsPerPixel = 72.0 / 96;

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;

// The file that Cairo writes to, and the first error of writing.
struct Sink {
  OutputFile& file;
  absl::Status status;
};

cairo_status_t write(void* closure, const unsigned char* data, unsigned int size) {
  Sink& sink = *static_cast<Sink*>(closure);
  if (sink.status.ok()) sink.status = sink.file.write(data, size);
  return sink.status.ok() ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

Surface create_surface(const Drawing& drawing, PlotFormat format, Sink& sink) {
  const double width = drawing.width(), height = drawing.height();
  switch (format) {
    case PlotFormat::kPng:
      return Surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, drawing.width(), drawing.height()));
    case PlotFormat::kSvg: {
      Surface svg(cairo_svg_surface_create_for_stream(write, &sink, width, height));
      cairo_svg_surface_set_document_unit(svg.get(), CAIRO_SVG_UNIT_PX);
      return svg;
    }
    case PlotFormat::kPdf: {
      Surface pdf(cairo_pdf_surface_create_for_stream(write, &sink, kPointsPerPixel * width, kPointsPerPixel * height));
      // Without this the file would state when it was made.
      cairo_pdf_surface_set_metadata(pdf.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
      return pdf;
    }
  }
  return nullptr;
}

void replay(const Drawing& drawing, double scale, cairo_surface_t* surface) {
  cairo_t* context = cairo_create(surface);
  cairo_scale(context, scale, scale);
  cairo_set_source_surface(context, drawing.recording(), 0, 0);
  cairo_paint(context);
  cairo_destroy(context);
}

}  // namespace

std::optional<PlotFormat> plot_format(const std::string& path) {
  if (absl::EndsWithIgnoreCase(path, ".png")) return PlotFormat::kPng;
  if (absl::EndsWithIgnoreCase(path, ".svg")) return PlotFormat::kSvg;
  if (absl::EndsWithIgnoreCase(path, ".pdf")) return PlotFormat::kPdf;
  return std::nullopt;
}

absl::Status write_plot(const Drawing& drawing, PlotFormat format, OutputFile& file) {
  if (format == PlotFormat::kPng && std::max(drawing.width(), drawing.height()) > kMostPixels) {
    return absl::OutOfRangeError(absl::StrCat("a plot of ", drawing.width(), " x ", drawing.height(),
                                              " pixels is too large for a PNG, whose sides have at most ", kMostPixels,
                                              "; expected a smaller --size, fewer panels, .svg or .pdf"));
  }
  Sink sink{file, absl::OkStatus()};
  const Surface surface = create_surface(drawing, format, sink);
  replay(drawing, format == PlotFormat::kPdf ? kPointsPerPixel : 1, surface.get());
  cairo_status_t status = drawing.status();
  if (format == PlotFormat::kPng && status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(surface.get(), write, &sink);
  }
  cairo_surface_finish(surface.get());
  if (!sink.status.ok()) return sink.status;
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("Cairo cannot write the plot: ", cairo_status_to_string(status)));
}

}  // namespace isofield
