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

// Reads a line "id type x y z radius parent", which may have further fields. Nothing: the line is another, or id, type
// or parent is no whole number.
std::optional<SwcRow> swc_row(absl::string_view line);

}  // namespace isofield
