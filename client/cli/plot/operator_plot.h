#pragma once

#include <string>
#include <vector>

#include "plot/drawing.h"

namespace isofield {

// The samples of an operator over the plane of its two operands, for a drawing as in Gourmel et al. (2013), Figs. 2 and
// 13.
struct OperatorPlot {
  struct Panel {
    std::string title;
    std::vector<float> g;           // side x side samples, the first operand fastest
    std::vector<Segment> boundary;  // the boundary of the blend, as operands; not drawn if empty
  };
  std::string heading;  // stands above all panels; shortened to their width
  std::string x_name, y_name;
  double low = 0, high = 1;  // the range of both operands
  int side = 0;
  double step = 0.1;     // the step between level curves; multiples of it are taken where they would be too dense
  double surface = 0.5;  // the level that is drawn heavily
  bool inside_above = true;
  std::vector<Panel> panels;
};

// Returns the levels that a panel of `size` pixels shows besides the surface, first those below it, then those above
// it, each time the nearest first. They are at multiples of the step, and levels whose lines would run together are
// left out.
std::vector<float> shown_levels(const OperatorPlot& plot, const std::vector<float>& g, int size);

// Draws the panels side by side. `size` is a panel's side in pixels.
Drawing draw(const OperatorPlot& plot, int size);

}  // namespace isofield
