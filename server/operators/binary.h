// The value of an operator of two operands with its partial derivatives. Operators are templates over the number:
// double, or reference::Dual, which carries derivatives along (numbers need +, -, *, /, sqrt, pow and value_of).
#pragma once

#include <cmath>

namespace isofield::operators {

template <class T>
struct Binary {
  T g, g1, g2;
};

inline double value_of(double x) {
  return x;
}

// The same operator with its operands exchanged.
template <class T>
Binary<T> exchanged(const Binary<T>& b) {
  return {b.g, b.g2, b.g1};
}

}  // namespace isofield::operators
