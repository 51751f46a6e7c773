#pragma once

#include <isofield/client.h>

#include <array>
#include <string>

#include "plot/drawing.h"

namespace isofield {

// Draws a slice: the field in shades, darker where it is greater, and its level curves, the first one heavily.
// `spacing` is the distance between samples along u and v in model units, `size` the plot's longer side in pixels. Both
// sides have the same scale.
Drawing draw(const Slice& slice, const std::array<double, 2>& spacing, const std::string& heading, int size);

}  // namespace isofield
