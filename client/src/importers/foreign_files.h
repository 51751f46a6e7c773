#pragma once

#include <absl/strings/string_view.h>

namespace isofield {

// Names a kind of file that isofield does not read, such as "a PNG picture", by the first 512 bytes, or all of a
// shorter file. Empty: the file is none of the known kinds.
absl::string_view foreign_file(absl::string_view start);

// The same for texts: meshes, molecules in other formats, web pages.
absl::string_view foreign_text(absl::string_view start);

}  // namespace isofield
