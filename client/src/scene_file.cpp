#include "isofield/scene_file.h"

#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>
#include <google/protobuf/util/json_util.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

namespace isofield {
namespace {

namespace json = google::protobuf::util;

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

absl::StatusOr<std::string> to_json(const google::protobuf::Message& message) {
  json::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string out;
  const auto status = json::MessageToJsonString(message, &out, options);
  if (!status.ok()) return absl::InternalError(absl::StrCat("cannot write JSON: ", status.message().ToString()));
  return out;
}

}  // namespace

absl::StatusOr<std::string> read_file(const std::string& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  struct stat information {};
  if (!file || ::fstat(::fileno(file.get()), &information) != 0) return absl::ErrnoToStatus(errno, path);
  if (S_ISDIR(information.st_mode)) return absl::ErrnoToStatus(EISDIR, path);
  std::string data;
  std::size_t used = 0;
  // A pipe has no size: it is read until it ends.
  data.resize(std::max<std::size_t>(static_cast<std::size_t>(std::max<off_t>(information.st_size, 0)) + 1, 65536));
  while (true) {
    const std::size_t got = std::fread(data.data() + used, 1, data.size() - used, file.get());
    used += got;
    if (got == 0) break;
    if (used == data.size()) data.resize(2 * data.size());
  }
  if (std::ferror(file.get())) return absl::ErrnoToStatus(errno, path);
  data.resize(used);
  return data;
}

absl::StatusOr<v1::Scene> parse_scene_json(const std::string& text, const std::string& name) {
  v1::Scene scene;
  const auto status = json::JsonStringToMessage(text, &scene, json::JsonParseOptions());
  if (!status.ok()) {
    const std::string message = status.message().ToString();
    return absl::InvalidArgumentError(absl::StrCat(name, place_of(text, message), ": not a scene in JSON: ", message));
  }
  return scene;
}

absl::StatusOr<v1::Scene> read_scene_file(const std::string& path) {
  const auto data = read_file(path);
  if (!data.ok()) return data.status();
  if (!absl::EndsWithIgnoreCase(path, ".pb")) return parse_scene_json(*data, path);
  v1::Scene scene;
  if (!scene.ParseFromString(*data)) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": not a binary isofield.v1.Scene message"));
  }
  return scene;
}

absl::StatusOr<std::string> format_scene_json(const v1::Scene& scene) {
  v1::Scene head;
  head.set_description(scene.description());
  head.set_unit(scene.unit());
  head.set_root(scene.root());
  auto out = to_json(head);
  if (!out.ok()) return out;
  out->pop_back();
  absl::StrAppend(&*out, out->size() > 1 ? ",\n" : "\n", "\"nodes\":[\n");
  for (int i = 0; i < scene.nodes_size(); ++i) {
    const auto node = to_json(scene.nodes(i));
    if (!node.ok()) return node;
    absl::StrAppend(&*out, *node, i + 1 < scene.nodes_size() ? ",\n" : "\n");
  }
  absl::StrAppend(&*out, "]}\n");
  return out;
}

}  // namespace isofield
