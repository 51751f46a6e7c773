#pragma once

#include <string>
#include <vector>

#include "plot/canvas.h"

namespace isofield {

// A font of straight strokes: digits, letters (all drawn as lower-case ones) and . , : - + = ( ) / _; others are
// blanks.

// Width of a text whose digits are `height` pixels high.
double text_width(const std::string& text, double height);

// Its strokes, the left end of the base line at (x, y).
std::vector<Segment> text_strokes(const std::string& text, double x, double y, double height);

}  // namespace isofield
