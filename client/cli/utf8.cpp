#include "utf8.h"

#include <absl/strings/str_cat.h>

#include <algorithm>

namespace isofield {
namespace {

// Returns the length in bytes of the UTF-8 character at the start of `text`, or 0 if the bytes are not UTF-8.
std::size_t character_length(absl::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) >= 0x80 && (byte(0) < 0xc2 || byte(0) > 0xf4)) return 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  // This refuses overlong forms, surrogates and codes beyond Unicode.
  const unsigned first = length > 1 ? byte(1) : 0;
  if ((byte(0) == 0xe0 && first < 0xa0) || (byte(0) == 0xed && first > 0x9f) || (byte(0) == 0xf0 && first < 0x90) ||
      (byte(0) == 0xf4 && first > 0x8f)) {
    return 0;
  }
  return length;
}

}  // namespace

std::string valid_utf8(absl::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    absl::StrAppend(&out, length == 0 ? "\xef\xbf\xbd" : text.substr(0, length));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace isofield
