#pragma once

#include <string>
#include <vector>

#include "plot/drawing.h"

namespace isofield {

// Opening functions theta(alpha), as in Gourmel et al. (2013), Fig. 15.
struct OpeningCurve {
  std::string name;
  std::vector<double> theta;  // degrees, at alpha evenly spread over [0, 180] degrees
};

// `size`: the plot's height in pixels; it is twice as wide.
Drawing draw(const std::vector<OpeningCurve>& curves, int size);

}  // namespace isofield
