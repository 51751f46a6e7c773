#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isofield {

// A value of Python as its source text writes it; as much as headers of NumPy files need.
struct PythonLiteral {
  enum class Kind { kText, kNumber, kName, kList, kDictionary };
  Kind kind = Kind::kName;
  // Of a text without quotes; of a number or name (True, None) as written.
  std::string text;
  // Of a list or tuple; of a dictionary keys and values in turn.
  std::vector<PythonLiteral> items;

  // Of a dictionary; nullptr: it has no such key.
  const PythonLiteral* find(absl::string_view key) const;
};

// Nothing: the text is not one such value, or nested more than 16 deep.
std::optional<PythonLiteral> parse_python_literal(absl::string_view text);

}  // namespace isofield
