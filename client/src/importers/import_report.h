#pragma once

#include <absl/strings/string_view.h>

#include <string>

#include "isofield/import.h"

namespace isofield {

// Counts a finding, and keeps the first few examples of each kind. There are few kinds, so they are searched in turn.
// Line 0: its place in the file is not known, and `line` is its name there; or empty, for the file as a whole.
void note(ImportReport& report, absl::string_view what, std::size_t line_number, absl::string_view line,
          bool damage = true);

}  // namespace isofield
