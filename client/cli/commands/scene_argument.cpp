#include "commands/scene_argument.h"

#include <absl/strings/ascii.h>
#include <absl/strings/match.h>
#include <absl/strings/str_cat.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "exit_codes.h"
#include "gzip.h"
#include "isofield/client.h"

namespace isofield {

absl::StatusOr<LoadedScene> load_scene(const std::string& path, const ImportOptions& options) {
  auto loaded = load_scene_file(path, options);
  if (!loaded.ok()) return file_error(loaded.status());
  if (loaded->report) std::fputs(loaded->report->text().c_str(), stderr);
  return loaded;
}

absl::StatusOr<v1::SceneRef> scene_argument(const std::string& argument, const ImportOptions& options) {
  std::error_code ignored;
  if (std::filesystem::exists(argument, ignored) && !std::filesystem::is_directory(argument, ignored)) {
    auto loaded = load_scene(argument, options);
    if (!loaded.ok()) return loaded.status();
    return inline_scene(std::move(loaded->scene));
  }
  // No name in the catalog ends like this by accident.
  const absl::string_view name = unpacked_name(argument);
  if (import_format(argument) || absl::EndsWithIgnoreCase(name, ".json") || absl::EndsWithIgnoreCase(name, ".pb")) {
    return file_error(absl::NotFoundError(absl::StrCat(argument, ": no such file")));
  }
  return scene_by_name(argument);
}

std::string stem(const std::string& path) {
  return std::filesystem::path(std::string(unpacked_name(path))).stem().string();
}

std::string name_for(const std::string& path) {
  std::string name = stem(path);
  for (char& c : name) {
    if (!absl::ascii_isalnum(c) && c != '_' && c != '-' && c != '.') c = '_';
  }
  return name.empty() ? "scene" : name.substr(0, 128);
}

}  // namespace isofield
