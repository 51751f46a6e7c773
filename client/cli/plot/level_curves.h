#pragma once

#include <span>
#include <vector>

#include "plot/segment.h"

namespace isofield {

// Where a function that is sampled at (i, j), 0 <= i, j < side, i fastest, has a value: marching squares, in those
// coordinates.
std::vector<Segment> level_curve(std::span<const float> values, int side, float level);

}  // namespace isofield
