#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <vector>

#include "output_file.h"

namespace isofield {

// A picture. Its rows begin at the top; each pixel has red, green and blue as sRGB bytes.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

// Writes a picture as a PNG, and does not commit the file. INTERNAL: libpng fails.
absl::Status write_png(const Image& image, OutputFile& file);

}  // namespace isofield
