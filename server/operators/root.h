// root_of() finds roots of increasing functions of one variable.
#pragma once

#include <cmath>
#include <utility>

namespace isofield::operators {

// Returns the root within [low, high] of an increasing function, to about the last bit. It takes steps of Newton's
// method if they stay within the bracket, and bisects if they do not and at every fourth step, so that it ends whatever
// the function. f(x) returns a pair of value and slope; a slope of 0, infinity or NaN is allowed.
template <class Function>
double root_of(double low, double high, const Function& f) {
  double x = 0.5 * (low + high);
  for (int i = 1; i < 4000 && x > low && x < high; ++i) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    (value < 0 ? low : high) = x;
    double next = x - value / slope;
    if (i % 4 == 0 || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == x) return x;
    x = next;
  }
  return x;
}

}  // namespace isofield::operators
