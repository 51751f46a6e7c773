// The units of length that a scene may state.
#pragma once

#include <optional>
#include <string>

namespace isofield {

// Returns the length of a unit in metres. `unit` is written as in Scene.unit: "m", "cm", "mm", "um" (or "µm",
// "micron"), "nm", "pm", "angstrom" (or "A", "Å"), "km", "in" or "ft", also in long forms such as "micrometres". A
// number above 0 may stand before it where the unit is a multiple: "8 nm". Returns nothing where the text names no
// length.
std::optional<double> unit_in_metres(const std::string& unit);

// The names of the units as a list for messages.
extern const char* const kUnitNames;

}  // namespace isofield
