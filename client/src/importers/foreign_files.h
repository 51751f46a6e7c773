#pragma once

#include <absl/strings/string_view.h>

namespace isofield {

// What a file is that isofield does not read, such as "a PNG picture", by the bytes that it begins with (512 do, or
// all). Empty: none of those that are known.
absl::string_view foreign_file(absl::string_view start);

// The same of texts: meshes, other molecules, web pages.
absl::string_view foreign_text(absl::string_view start);

}  // namespace isofield
