// Text of others in messages: names that a client sent, made fit to be read and to travel in a status.
#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <string>

namespace isofield::base {

// Characters of a name that errors repeat.
inline constexpr std::size_t kQuotedCharacters = 80;

// `text` as valid UTF-8 without control characters: these, and bytes that are no UTF-8, become escapes such as \n and
// \x1b. Where it would have more characters or bytes than these it is cut and ends with "..."; an escape has several.
std::string printable(absl::string_view text, std::size_t most_characters,
                      std::size_t most_bytes = std::string::npos);

// As many whole characters of `text`, which is UTF-8, as its first `most` bytes hold.
absl::string_view utf8_prefix(absl::string_view text, std::size_t most);

// printable() in single quotes, cut at kQuotedCharacters.
std::string quoted(absl::string_view name);

}  // namespace isofield::base
