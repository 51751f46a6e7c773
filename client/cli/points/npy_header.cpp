#include "points/npy_header.h"

#include <absl/strings/str_cat.h>

namespace isofield {

std::string npy_header(std::uint64_t rows, std::uint64_t columns) {
  // With the padding that the format asks for.
  constexpr std::size_t kBytes = 128;
  std::string description =
      absl::StrCat("{'descr': '<f4', 'fortran_order': False, 'shape': (", rows, ", ", columns, "), }");
  description.resize(kBytes - 11, ' ');
  description.push_back('\n');
  std::string text("\x93NUMPY\x01\x00", 8);
  text.push_back(static_cast<char>(description.size()));
  text.push_back('\0');
  return text + description;
}

}  // namespace isofield
