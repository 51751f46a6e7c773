#pragma once

#include <absl/status/status.h>

#include <cstdint>
#include <vector>

#include "output_file.h"

namespace isofield {

// Rows from the top; red, green, blue as sRGB bytes.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

// Does not commit the file.
absl::Status write_png(const Image& image, OutputFile& file);

}  // namespace isofield
