// Imports the files of the program Tinker, which have the same extension as XYZ files.
#pragma once

#include <absl/status/status.h>

#include <vector>

#include "importers/xyz_frames.h"
#include "isofield/import.h"

namespace isofield {

// Returns true for a file of Tinker: a numbered atom, "1 O 0.0 0.0 0.0 ...", follows the count, possibly after the six
// numbers of a periodic box.
bool is_tinker(const std::vector<TextLine>& lines, std::size_t header_line);

// Imports frames of "count title" and lines of "number name x y z type bonds". Errors are those of choose_frame().
absl::Status import_tinker(const std::vector<TextLine>& lines, std::size_t header_line, const ImportOptions& options,
                           Imported& imported);

}  // namespace isofield
