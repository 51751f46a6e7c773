#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>

namespace isofield {

// Which fields of an atom's line hold its element and its position, counted from 0.
struct XyzColumns {
  std::optional<std::size_t> species = 0;
  // The field of the atomic number.
  std::optional<std::size_t> number;
  std::size_t position = 1;
};

// The columns that the comment line of extended XYZ states in any order ("Properties=species:S:1:pos:R:3"). Nothing: it
// states none, or `valid` is set to false because they cannot be understood or lack the positions.
std::optional<XyzColumns> parse_columns(absl::string_view comment, bool& valid);

}  // namespace isofield
