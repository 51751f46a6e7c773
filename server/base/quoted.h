// Prepares texts that a client sent, such as names, for error messages: they become readable, short, and valid in a
// gRPC status.
#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <string>

namespace isofield::base {

// Errors repeat at most this many characters of a name.
inline constexpr std::size_t kQuotedCharacters = 80;

// Turns `text` into valid UTF-8 without control characters: these, and bytes that are not UTF-8, become escapes such as
// \n and \x1b. A result that would have more than `most_characters` or `most_bytes` is cut, and "..." is appended. An
// escape counts as several characters.
std::string printable(absl::string_view text, std::size_t most_characters, std::size_t most_bytes = std::string::npos);

// Returns the longest beginning of `text`, which is UTF-8, that has at most `most` bytes and ends with a whole
// character.
absl::string_view utf8_prefix(absl::string_view text, std::size_t most);

// Returns printable(name) in single quotes, cut at kQuotedCharacters.
std::string quoted(absl::string_view name);

}  // namespace isofield::base
