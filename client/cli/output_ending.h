#pragma once

#include <absl/status/status.h>

#include <initializer_list>
#include <string>

namespace isofield {

// Refuses an output whose ending is that of a kind of file which the command does not write, and names the command that
// does: "a.glb" is no name for a scene. `written` has the endings that the command writes. Unknown endings are
// accepted.
absl::Status check_output_ending(const std::string& path, std::initializer_list<const char*> written);

}  // namespace isofield
