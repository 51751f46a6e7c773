#pragma once

#include <absl/status/status.h>

#include <initializer_list>
#include <string>

namespace isofield {

// Refuses an output whose name ends like a kind of file that the command does not write, such as a scene "a.glb", with
// a word on the command that does. `written`: the endings that the command knows; other names are left to it.
absl::Status check_output_ending(const std::string& path, std::initializer_list<const char*> written);

}  // namespace isofield
