#pragma once

#include <absl/status/status.h>

#include <optional>
#include <string>

#include "output_file.h"
#include "plot/drawing.h"

namespace isofield {

enum class PlotFormat { kPng, kSvg, kPdf };

// Returns the format that a file's ending names: .png, .svg or .pdf. Nothing: the ending is another one.
std::optional<PlotFormat> plot_format(const std::string& path);

// Writes a drawing, and does not commit the file. The same drawing makes the same bytes if the same font is installed,
// but the ids of an SVG go on counting within a process. In SVG and PDF a pixel is 1/96 inch. A PDF has text that can
// be searched, an SVG the outlines of its letters. OUT_OF_RANGE: the drawing is too large for a PNG. INTERNAL: Cairo
// fails.
absl::Status write_plot(const Drawing& drawing, PlotFormat format, OutputFile& file);

}  // namespace isofield
