// Fills in the report of an import.
#pragma once

#include <absl/strings/string_view.h>

#include <string>

#include "isofield/import.h"

namespace isofield {

// Counts a finding, and keeps the first few examples of each kind. There are few kinds, so they are searched in turn.
// `line_number` is 0 where the place in the file is not known: `line` is then the entry's name, or empty where the
// finding is about the file as a whole.
void note(ImportReport& report, absl::string_view what, std::size_t line_number, absl::string_view line,
          bool damage = true);

}  // namespace isofield
