#pragma once

#include <absl/status/status.h>

#include <vector>

#include "importers/xyz_frames.h"
#include "isofield/import.h"

namespace isofield {

// True where a numbered atom, "1 O 0.0 0.0 0.0 ...", follows the count, possibly after six numbers of a box: a file of
// the program Tinker, which shares its extension with XYZ.
bool is_tinker(const std::vector<TextLine>& lines, std::size_t header_line);

// Lines of "number name x y z type bonds" after "count title", frame after frame.
absl::Status import_tinker(const std::vector<TextLine>& lines, std::size_t header_line, const ImportOptions& options,
                           Imported& imported);

}  // namespace isofield
