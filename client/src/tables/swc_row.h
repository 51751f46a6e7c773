// Recognises the lines of SWC files.
#pragma once

#include <absl/strings/string_view.h>

#include <optional>

namespace isofield {

// The parts of a line that tell whether it belongs to an SWC file or is seven numbers of another meaning.
struct SwcRow {
  absl::string_view id;
  absl::string_view parent;
  // True where the parent is negative or the sample itself.
  bool is_root = false;
};

// Reads a line "id type x y z radius parent", which may have further fields. Returns nothing where it is another line,
// or where id, type or parent is not a whole number.
std::optional<SwcRow> swc_row(absl::string_view line);

}  // namespace isofield
