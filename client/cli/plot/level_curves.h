#pragma once

#include <span>
#include <vector>

#include "plot/segment.h"

namespace isofield {

// Finds the curve on which a function has the value `level`, by marching squares. The function is sampled at (i, j),
// 0 <= i, j < side, with i fastest; the curve is in these coordinates.
std::vector<Segment> level_curve(std::span<const float> values, int side, float level);

}  // namespace isofield
