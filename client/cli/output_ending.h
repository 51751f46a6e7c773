#pragma once

#include <absl/status/status.h>

#include <initializer_list>
#include <string>

namespace isofield {

// Checks the name of an output file, so that a command does not write a scene to "a.glb". It refuses, as an error of
// usage, an ending that means a kind of file which the command does not write; the message names the command that does.
// `written` lists the endings that the command writes. Unknown endings are accepted.
absl::Status check_output_ending(const std::string& path, std::initializer_list<const char*> written);

}  // namespace isofield
