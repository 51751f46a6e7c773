#pragma once

#include <absl/strings/string_view.h>

#include <array>

#include "importers/elements.h"
#include "isofield/import.h"

namespace isofield {

// An atom's place in its file, for the report.
struct AtomSource {
  std::size_t line_number;
  absl::string_view line;
};

// Adds a van der Waals sphere; notes an element that is unknown (null) or has no radius. Returns the new node, still
// without a name.
v1::Node& add_atom(const Element* element, const std::array<double, 3>& center, const AtomSource& source,
                   const ImportOptions& options, Imported& imported);

}  // namespace isofield
