#pragma once

#include <string>
#include <vector>

#include "render/image.h"

namespace isofield {

// An operator over the plane of its two operands, as in Gourmel et al. (2013), Figs. 2 and 13.
struct OperatorPlot {
  struct Panel {
    std::string title;
    std::vector<float> g;  // side x side samples, the first operand fastest
  };
  std::string x_name, y_name;
  double low = 0, high = 1;  // of both operands
  int side = 0;
  double step = 0.1;     // between level curves
  double surface = 0.5;  // the level that is drawn heavily
  bool inside_above = true;
  // What g is where nothing is blended, as in a panel's g; empty: not drawn. The boundary of the blend is where g
  // leaves it on the way from an axis to the diagonal.
  std::vector<float> unblended;
  std::vector<Panel> panels;
};

// `size`: a panel's side in pixels.
Image draw(const OperatorPlot& plot, int size);

}  // namespace isofield
