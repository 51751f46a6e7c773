// The value of an operator of two operands with its partial derivatives. Operators are templates over the number:
// double, or reference::Dual, which carries derivatives along (numbers need +, -, *, /, sqrt, pow and value_of).
#pragma once

#include <cmath>

#include "base/value_of.h"

namespace isofield::operators {

template <class T>
struct Binary {
  T g, g1, g2;
};

// Signed fields of nested and folded operators end here, where float32 nearly does, and are constant beyond.
inline constexpr double kMostField = 1e37;

using base::value_of;

// The same operator with its operands exchanged.
template <class T>
Binary<T> exchanged(const Binary<T>& b) {
  return {b.g, b.g2, b.g1};
}

}  // namespace isofield::operators
