#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isofield {

// A Python value as written in source text; only what headers of NumPy files need.
struct PythonLiteral {
  enum class Kind { kText, kNumber, kName, kList, kDictionary };
  Kind kind = Kind::kName;
  // A text without its quotes; a number or a name (True, None) as written.
  std::string text;
  // The items of a list or a tuple; the keys and values of a dictionary in turn.
  std::vector<PythonLiteral> items;

  // The value of a key; nullptr where this is no dictionary or has no such key.
  const PythonLiteral* find(absl::string_view key) const;
};

// Parses a text that is one value. Nothing: it is not, or it is nested more than 16 deep.
std::optional<PythonLiteral> parse_python_literal(absl::string_view text);

}  // namespace isofield
