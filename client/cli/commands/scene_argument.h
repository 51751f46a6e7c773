#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/import.h"
#include "isofield/v1/scene.pb.h"

namespace isofield {

// Calls load_scene_file(), and prints an import's report on the standard error.
absl::StatusOr<LoadedScene> load_scene(const std::string& path, const ImportOptions& options);

// SCENE of the command line: a file if there is one of that name, else a name on the server.
absl::StatusOr<v1::SceneRef> scene_argument(const std::string& argument, const ImportOptions& options);

// A file's name without its directories and extension.
std::string stem(const std::string& path);
// The same in the letters that a name on the server may have.
std::string name_for(const std::string& path);

}  // namespace isofield
