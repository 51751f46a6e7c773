// value_of(x) is the plain number in x. Formulas are templates over their number type: double, or a type that carries
// derivatives along (reference/), which has a value_of() of its own.
#pragma once

namespace isofield::base {

inline double value_of(double x) {
  return x;
}

}  // namespace isofield::base
