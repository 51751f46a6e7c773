#pragma once

#include <absl/strings/string_view.h>

#include <cstddef>
#include <optional>

namespace isofield {

// Which fields of an atom's line hold what, from 0.
struct XyzColumns {
  std::optional<std::size_t> species = 0;
  // Atomic number.
  std::optional<std::size_t> number;
  std::size_t position = 1;
};

// The columns that the comment line of extended XYZ states ("Properties=species:S:1:pos:R:3"), in any order. Nothing:
// it states none. `valid` becomes false where what it states cannot be understood, or has no positions.
std::optional<XyzColumns> parse_columns(absl::string_view comment, bool& valid);

}  // namespace isofield
