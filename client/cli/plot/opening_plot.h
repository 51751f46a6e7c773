#pragma once

#include <string>
#include <vector>

#include "plot/drawing.h"

namespace isofield {

// A sampled opening function theta(alpha), as it is drawn in Gourmel et al. (2013), Fig. 15.
struct OpeningCurve {
  std::string name;
  std::vector<double> theta;  // degrees, at alpha evenly spread over [0, 180] degrees
};

// Draws the curves into one frame, which is `size` pixels high and twice as wide.
Drawing draw(const std::vector<OpeningCurve>& curves, int size);

}  // namespace isofield
