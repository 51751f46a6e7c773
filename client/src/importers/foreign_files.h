// Recognises files of other programs, so that an error can say what they are.
#pragma once

#include <absl/strings/string_view.h>

namespace isofield {

// Names a kind of file that isofield does not read, such as "a PNG picture". `start` holds at least the first 512 bytes
// of the file, or all of a shorter one. Returns nothing where the file is none of the known kinds.
absl::string_view foreign_file(absl::string_view start);

// Does the same for texts: meshes, molecules in other formats and web pages.
absl::string_view foreign_text(absl::string_view start);

}  // namespace isofield
