// Formulas are templates over the number: double, or one that carries derivatives along (reference/), which has a
// value_of of its own.
#pragma once

namespace isofield::base {

inline double value_of(double x) {
  return x;
}

}  // namespace isofield::base
