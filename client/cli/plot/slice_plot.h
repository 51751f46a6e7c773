#pragma once

#include <isofield/client.h>

#include <array>
#include <string>

#include "plot/drawing.h"

namespace isofield {

// A slice as a picture: the field in shades, darker where it is greater, and its level curves, the first one heavily.
// `spacing`: model units between samples along u and v. `size`: pixels of the plot's longer side; both sides have the
// same scale.
Drawing draw(const Slice& slice, const std::array<double, 2>& spacing, const std::string& heading, int size);

}  // namespace isofield
