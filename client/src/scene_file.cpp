#include "isofield/scene_file.h"

#include <absl/strings/str_cat.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "gzip.h"
#include "json_text.h"

namespace isofield {

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
  if (!is_gzip(data)) return data;
  auto unpacked = gunzip(data);
  if (unpacked.ok()) return unpacked;
  return absl::Status(unpacked.status().code(), absl::StrCat(path, ": ", unpacked.status().message()));
}

absl::StatusOr<v1::Scene> parse_scene_json(const std::string& text, const std::string& name) {
  v1::Scene scene;
  if (auto status = parse_json(text, name, "a scene", scene); !status.ok()) return status;
  return scene;
}

absl::StatusOr<v1::Scene> read_scene_file(const std::string& path) {
  const auto data = read_file(path);
  if (!data.ok()) return data.status();
  v1::Scene scene;
  if (auto status = parse_file(*data, path, "a scene", scene); !status.ok()) return status;
  return scene;
}

absl::StatusOr<std::string> format_scene_json(const v1::Scene& scene) {
  v1::Scene head;
  head.set_description(scene.description());
  head.set_unit(scene.unit());
  head.set_root(scene.root());
  auto out = format_json(head);
  if (!out.ok()) return out;
  out->pop_back();
  absl::StrAppend(&*out, out->size() > 1 ? ",\n" : "\n", "\"nodes\":[\n");
  for (int i = 0; i < scene.nodes_size(); ++i) {
    const auto node = format_json(scene.nodes(i));
    if (!node.ok()) return node;
    absl::StrAppend(&*out, *node, i + 1 < scene.nodes_size() ? ",\n" : "\n");
  }
  absl::StrAppend(&*out, "]}\n");
  return out;
}

}  // namespace isofield
