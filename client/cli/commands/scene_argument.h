#pragma once

#include <absl/status/statusor.h>

#include <string>

#include "isofield/import.h"
#include "isofield/v1/scene.pb.h"

namespace isofield {

// Calls load_scene_file(), and prints an import's report on the standard error.
absl::StatusOr<LoadedScene> load_scene(const std::string& path, const ImportOptions& options);

// Turns the argument SCENE into a reference. If there is a file of that name, its scene is loaded or imported and sent
// with the request; otherwise the argument is a name on the server. NOT_FOUND, as a file error: there is no such file,
// but the argument ends like a file of a scene or one to import.
absl::StatusOr<v1::SceneRef> scene_argument(const std::string& argument, const ImportOptions& options);

// Returns a file's name without its directories, its extension and a ".gz" after that.
std::string stem(const std::string& path);
// Returns the same in the characters that a name on the server may have: others become "_", and at most 128 are kept.
std::string name_for(const std::string& path);

}  // namespace isofield
