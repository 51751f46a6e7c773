// Curve is the value of a function of one variable with its first two derivatives.
#pragma once

namespace isofield::operators {

struct Curve {
  double v = 0;   // value
  double d1 = 0;  // first derivative
  double d2 = 0;  // second derivative
};

}  // namespace isofield::operators
