#include "base/quoted.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_format.h>

#include <algorithm>

namespace isofield::base {
namespace {

struct Character {
  std::size_t bytes = 1;
  bool is_plain = false;  // valid UTF-8 and no control character
};

// Reads the first character of `text`, which must not be empty (RFC 3629). A byte that begins no valid UTF-8 character
// counts as one character that is not plain.
Character first_of(absl::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead >= 0x20 && lead != 0x7f};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  unsigned code = lead & (0xff >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || code > 0x10ffff || is_surrogate) return {};
  const bool is_control = code < 0xa0 || code == 0x2028 || code == 0x2029;  // C1, and separators of lines
  return {bytes, !is_control};
}

std::string escape(absl::string_view bytes) {
  if (bytes == "\n") return "\\n";
  if (bytes == "\r") return "\\r";
  if (bytes == "\t") return "\\t";
  std::string escaped;
  for (const unsigned char c : bytes) absl::StrAppendFormat(&escaped, "\\x%02x", c);
  return escaped;
}

}  // namespace

std::string printable(absl::string_view text, std::size_t most_characters, std::size_t most_bytes) {
  // This is a short cut: names of nodes are nearly always plain and short, and a scene has up to a million of them.
  const auto is_ascii = [](unsigned char c) { return c >= 0x20 && c < 0x7f; };
  if (text.size() <= std::min(most_characters, most_bytes) && std::all_of(text.begin(), text.end(), is_ascii)) {
    return std::string(text);
  }
  std::string out;
  std::size_t characters = 0;
  while (!text.empty()) {
    const Character next = first_of(text);
    const absl::string_view bytes = text.substr(0, next.bytes);
    const std::string shown = next.is_plain ? std::string(bytes) : escape(bytes);
    characters += next.is_plain ? 1 : shown.size();
    if (characters > most_characters || out.size() + shown.size() > most_bytes) return out + "...";
    out += shown;
    text.remove_prefix(next.bytes);
  }
  return out;
}

absl::string_view utf8_prefix(absl::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  return text.substr(0, most);
}

std::string quoted(absl::string_view name) {
  return absl::StrCat("'", printable(name, kQuotedCharacters), "'");
}

}  // namespace isofield::base
