// The columns of extended XYZ files.
#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>

namespace isofield {

// The fields of the line of an atom that hold its element and its position, counted from 0.
struct XyzColumns {
  // The field of the element.
  std::optional<std::size_t> species = 0;
  // The field of the atomic number.
  std::optional<std::size_t> number;
  // The first of the three fields of the position.
  std::size_t position = 1;
};

// Returns the columns that the comment line of extended XYZ states in any order ("Properties=species:S:1:pos:R:3").
// Returns nothing where it states none, or where they cannot be understood or lack the positions; `valid` is false in
// the second case.
std::optional<XyzColumns> parse_columns(absl::string_view comment, bool& valid);

}  // namespace isofield
