#pragma once

#include <absl/strings/string_view.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isofield {

// A Python value as it is written in source text. Only the kinds that headers of NumPy files need are supported.
struct PythonLiteral {
  enum class Kind { kText, kNumber, kName, kList, kDictionary };
  Kind kind = Kind::kName;
  // A text is kept without its quotes; a number or a name (True, None) is kept as it is written.
  std::string text;
  // A list or tuple has its items here, a dictionary its keys and values in turn.
  std::vector<PythonLiteral> items;

  // Returns the value of a key, or nullptr if this is not a dictionary or has no such key.
  const PythonLiteral* find(absl::string_view key) const;
};

// Parses a text that is one value. Nothing: the text is not one value, or it is nested more than 16 deep.
std::optional<PythonLiteral> parse_python_literal(absl::string_view text);

}  // namespace isofield
