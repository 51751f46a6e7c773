#pragma once

#include <string>
#include <vector>

#include "plot/drawing.h"

namespace isofield {

// An operator over the plane of its two operands, as in Gourmel et al. (2013), Figs. 2 and 13.
struct OperatorPlot {
  struct Panel {
    std::string title;
    std::vector<float> g;           // side x side samples, the first operand fastest
    std::vector<Segment> boundary;  // of the blend, in operands; empty: not drawn
  };
  std::string heading;  // above all panels; shortened to their width
  std::string x_name, y_name;
  double low = 0, high = 1;  // of both operands
  int side = 0;
  double step = 0.1;     // between level curves; multiples of it where they would be too dense
  double surface = 0.5;  // the level that is drawn heavily
  bool inside_above = true;
  std::vector<Panel> panels;
};

// The levels that a panel of `size` pixels shows besides the surface, the nearest ones first on each side of it: at
// multiples of the step, but none so near to the one before that lines would run together.
std::vector<float> shown_levels(const OperatorPlot& plot, const std::vector<float>& g, int size);

// `size`: a panel's side in pixels.
Drawing draw(const OperatorPlot& plot, int size);

}  // namespace isofield
