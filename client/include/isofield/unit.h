#pragma once

#include <optional>
#include <string>

namespace isofield {

// The length of a unit in metres, as Scene.unit names it: "m", "cm", "mm", "um" (or "µm", "micron"), "nm", "pm",
// "angstrom" (or "Å"), "km", "in" or "ft", also in their long forms such as "micrometres", with a number above 0 before
// it where the unit is a multiple: "8 nm". Nothing: the text names no length.
std::optional<double> unit_in_metres(const std::string& unit);

// The units that have a name, for messages.
extern const char* const kUnitNames;

}  // namespace isofield
