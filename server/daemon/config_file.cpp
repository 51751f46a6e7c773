#include "daemon/config_file.h"

#include <absl/container/flat_hash_map.h>
#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/str_replace.h>
#include <absl/strings/strip.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

namespace isofield::daemon {
namespace {

constexpr char kExpectedLine[] = "expected KEY = VALUE, such as max-scenes = 100 or listen = \"127.0.0.1:50051\"";
constexpr char kExpectedValue[] = "expected a text in quotes, a number, true or false";

bool is_key_letter(char c) {
  return absl::ascii_isalnum(c) || c == '-' || c == '_';
}

// Takes a text in quotes off the front of `rest`. A basic string ("") may contain escapes, a literal one ('') does not.
// Returns nothing if the text does not end or has an unknown escape.
std::optional<std::string> take_text(absl::string_view& rest) {
  const char quote = rest.front();
  std::string text;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    char c = rest[i];
    if (c == quote) {
      rest.remove_prefix(i + 1);
      return text;
    }
    if (c == '\\' && quote == '"') {
      const absl::string_view escapes = "\"\\tnrbf", meanings = "\"\\\t\n\r\b\f";
      const std::size_t which = ++i < rest.size() ? escapes.find(rest[i]) : absl::string_view::npos;
      if (which == absl::string_view::npos) return std::nullopt;
      c = meanings[which];
    }
    text.push_back(c);
  }
  return std::nullopt;
}

// Reads a whole number of TOML: an optional sign and decimal digits, or digits after the prefix 0x, 0o or 0b, with
// underscores between digits allowed. Returns it in decimal digits, or nothing if `text` is no such number.
std::optional<std::string> whole_number(absl::string_view text) {
  const std::string digits = absl::StrReplaceAll(text, {{"_", ""}});
  absl::string_view bare = digits;
  for (const auto& [prefix, base] : {std::pair("0x", 16), std::pair("0o", 8), std::pair("0b", 2)}) {
    if (!absl::ConsumePrefix(&bare, prefix)) continue;
    std::uint64_t value = 0;
    const char* const end = bare.data() + bare.size();
    const auto [after, error] = std::from_chars(bare.data(), end, value, base);
    return after == end && error == std::errc() ? std::optional(absl::StrCat(value)) : std::nullopt;
  }
  const bool is_negative = absl::ConsumePrefix(&bare, "-");
  if (!is_negative) absl::ConsumePrefix(&bare, "+");
  if (bare.empty() || bare.find_first_not_of("0123456789") != absl::string_view::npos) return std::nullopt;
  return absl::StrCat(is_negative ? "-" : "", bare);
}

// Takes a value off the front of `rest`, and fills in its kind and text. Returns false if it is no value of TOML.
bool take_value(absl::string_view& rest, ConfigLine& out) {
  const absl::string_view all = rest;
  if (rest.front() == '"' || rest.front() == '\'') {
    const std::optional<std::string> text = take_text(rest);
    out.written = std::string(text ? all.substr(0, all.size() - rest.size()) : all);
    if (!text) return false;
    out.value = *text;
    return true;
  }
  out.written = std::string(absl::StripAsciiWhitespace(all.substr(0, all.find('#'))));
  rest.remove_prefix(std::min(rest.size(), rest.find('#')));
  double number = 0;
  if (out.written == "true" || out.written == "false") {
    out.kind = ConfigLine::Kind::kTruth;
    out.value = out.written;
  } else if (const auto whole = whole_number(out.written)) {
    out.kind = ConfigLine::Kind::kWholeNumber;
    out.value = *whole;
  } else if (absl::SimpleAtod(out.written, &number)) {
    out.kind = ConfigLine::Kind::kNumber;
    out.value = out.written;
  } else {
    return false;
  }
  return true;
}

// Reads one line into `out`, except for the number of the line. INVALID_ARGUMENT: the message says what is wrong.
absl::Status parse_line(absl::string_view text, ConfigLine& out) {
  const auto refuse = [](absl::string_view what, absl::string_view expected) {
    return absl::InvalidArgumentError(absl::StrCat(what.substr(0, 80), ": ", expected));
  };
  if (text.front() == '[') return refuse(text, absl::StrCat("this file has no tables; ", kExpectedLine));
  absl::string_view rest = text;
  if (rest.front() == '"' || rest.front() == '\'') {
    const auto key = take_text(rest);
    if (!key) return refuse(text, kExpectedLine);
    out.key = *key;
  } else {
    while (!rest.empty() && is_key_letter(rest.front())) {
      out.key.push_back(rest.front());
      rest.remove_prefix(1);
    }
  }
  rest = absl::StripLeadingAsciiWhitespace(rest);
  if (out.key.empty() || !absl::ConsumePrefix(&rest, "=")) return refuse(text, kExpectedLine);
  rest = absl::StripLeadingAsciiWhitespace(rest);
  if (rest.empty() || rest.front() == '#') return refuse(absl::StrCat(out.key, " = "), kExpectedValue);
  if (!take_value(rest, out)) return refuse(absl::StrCat(out.key, " = ", out.written), kExpectedValue);
  rest = absl::StripLeadingAsciiWhitespace(rest);
  if (!rest.empty() && rest.front() != '#') {
    return refuse(rest,
                  absl::StrCat("expected the end of the line, or a comment (#), after ", out.key, " = ", out.written));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::vector<ConfigLine>> read_config_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return absl::ErrnoToStatus(EISDIR, path);
  errno = 0;
  std::ifstream file(path);
  if (!file) return absl::ErrnoToStatus(errno == 0 ? EIO : errno, path);
  std::vector<ConfigLine> lines;
  absl::flat_hash_map<std::string, int> places;
  std::string text;
  for (int number = 1; std::getline(file, text); ++number) {
    absl::string_view rest = text;
    if (number == 1) absl::ConsumePrefix(&rest, "\xef\xbb\xbf");
    rest = absl::StripAsciiWhitespace(rest);
    if (rest.empty() || rest.front() == '#') continue;
    ConfigLine& line = lines.emplace_back();
    line.line = number;
    absl::Status status = parse_line(rest, line);
    const auto [place, is_new] = places.emplace(line.key, number);
    if (status.ok() && !is_new) {
      status = absl::InvalidArgumentError(absl::StrCat(line.key, " is set twice in this file: line ", place->second,
                                                       " sets it, too; expected each key once"));
    }
    if (!status.ok()) return absl::InvalidArgumentError(absl::StrCat(path, ":", number, ": ", status.message()));
  }
  if (file.bad()) return absl::ErrnoToStatus(errno == 0 ? EIO : errno, path);
  return lines;
}

}  // namespace isofield::daemon
