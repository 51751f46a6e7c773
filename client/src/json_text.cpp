#include "json_text.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/strip.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>

namespace isofield {
namespace {

namespace json = google::protobuf::util;

constexpr absl::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The parser quotes the neighbourhood of a syntax error on a second line and points at it on a third. Says where in
// the text that is, or nothing when the quotation is not found exactly once.
std::string place_of(const std::string& text, const std::string& message) {
  const std::size_t quote = message.find('\n');
  const std::size_t pointer = message.rfind('\n');
  if (quote == std::string::npos || quote == pointer) return "";
  const std::string excerpt = message.substr(quote + 1, pointer - quote - 1);
  const std::size_t found = text.find(excerpt);
  if (excerpt.empty() || found == std::string::npos || text.find(excerpt, found + 1) != std::string::npos) return "";
  const std::size_t at = std::min(text.size(), found + message.size() - pointer - 2);
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  const std::size_t line_start = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return absl::StrCat(":", line, ":", at - (line_start == std::string::npos ? 0 : line_start + 1) + 1);
}

}  // namespace

absl::Status parse_json(const std::string& text, const std::string& name, const std::string& what,
                        google::protobuf::Message& message) {
  if (absl::StartsWith(text, kByteOrderMark)) return parse_json(text.substr(kByteOrderMark.size()), name, what, message);
  const auto status = json::JsonStringToMessage(text, &message, json::JsonParseOptions());
  if (status.ok()) return absl::OkStatus();
  const std::string reason = status.message().ToString();
  return absl::InvalidArgumentError(absl::StrCat(name, place_of(text, reason), ": not ", what, " in JSON: ", reason));
}

bool is_json(absl::string_view content) {
  absl::ConsumePrefix(&content, kByteOrderMark);
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != absl::string_view::npos && content[first] == '{';
}

absl::Status parse_file(const std::string& content, const std::string& name, const std::string& what,
                        google::protobuf::Message& message) {
  if (is_json(content) || !absl::EndsWithIgnoreCase(absl::StripSuffix(name, ".gz"), ".pb")) return parse_json(content, name, what, message);
  if (message.ParseFromString(content)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(name, ": not a binary ", message.GetTypeName(), " message"));
}

absl::StatusOr<std::string> format_json(const google::protobuf::Message& message) {
  json::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string out;
  const auto status = json::MessageToJsonString(message, &out, options);
  if (!status.ok()) return absl::InternalError(absl::StrCat("cannot write JSON: ", status.message().ToString()));
  return out;
}

}  // namespace isofield
