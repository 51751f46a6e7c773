#pragma once

#include <absl/strings/string_view.h>

#include <optional>

namespace isofield {

// What tells a line of an SWC file from seven numbers of other meaning.
struct SwcRow {
  absl::string_view id;
  absl::string_view parent;
  // The parent is negative or the sample itself.
  bool is_root = false;
};

// Nothing: the line is not "id type x y z radius parent", and maybe more, with whole numbers for id, type and parent.
std::optional<SwcRow> swc_row(absl::string_view line);

}  // namespace isofield
