#include "json_text.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <absl/strings/strip.h>
#include <google/protobuf/util/json_util.h>

#include "gzip.h"
#include "json_misfit.h"

namespace isofield {
namespace {

namespace json = google::protobuf::util;

constexpr absl::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

absl::Status parse_json(const std::string& text, const std::string& name, const std::string& what,
                        google::protobuf::Message& message) {
  if (absl::StartsWith(text, kByteOrderMark)) {
    return parse_json(text.substr(kByteOrderMark.size()), name, what, message);
  }
  const JsonMisfit misfit = find_misfit(text, *message.GetDescriptor());
  const auto refuse = [&] {
    return absl::InvalidArgumentError(absl::StrCat(name, ":", misfit.place, ": not ", what, " in JSON: ", misfit.text));
  };
  if (misfit.kind == JsonMisfit::Kind::kMeaning) return refuse();
  const auto status = json::JsonStringToMessage(text, &message, json::JsonParseOptions());
  if (status.ok()) return absl::OkStatus();
  if (misfit.kind == JsonMisfit::Kind::kSyntax) return refuse();
  return absl::InvalidArgumentError(absl::StrCat(name, ": not ", what, " in JSON: ", status.message().ToString()));
}

bool is_json(absl::string_view content) {
  absl::ConsumePrefix(&content, kByteOrderMark);
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != absl::string_view::npos && content[first] == '{';
}

absl::Status parse_file(const std::string& content, const std::string& name, const std::string& what,
                        google::protobuf::Message& message) {
  const bool is_binary = absl::EndsWithIgnoreCase(unpacked_name(name), ".pb") && !is_json(content);
  if (!is_binary) return parse_json(content, name, what, message);
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
