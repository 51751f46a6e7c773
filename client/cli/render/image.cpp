#include "render/image.h"

#include <absl/strings/str_cat.h>
#include <png.h>

namespace isofield {

absl::Status write_png(const Image& image, OutputFile& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr)) {
    return absl::InternalError(absl::StrCat("cannot write a PNG: ", png.message));
  }
  return file.write(bytes.data(), size);
}

}  // namespace isofield
