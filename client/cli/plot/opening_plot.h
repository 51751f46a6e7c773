#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace isofield {

// Opening functions theta(alpha), as in Gourmel et al. (2013), Fig. 15.
struct OpeningCurve {
  std::string name;
  std::vector<double> theta;  // degrees, at alpha evenly spread over [0, 180] degrees
};

// `size`: the plot's height in pixels; it is twice as wide.
Image draw(const std::vector<OpeningCurve>& curves, int size);

}  // namespace isofield
