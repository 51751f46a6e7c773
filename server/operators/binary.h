// Binary is the value of an operator of two operands with its partial derivatives. Operators are templates over the
// number type: double, or reference::Dual, which carries derivatives along. A number type needs +, -, *, /, sqrt, pow
// and value_of.
#pragma once

#include <cmath>

#include "base/value_of.h"

namespace isofield::operators {

template <class T>
struct Binary {
  T g, g1, g2;
};

// Signed fields of nested and folded operators stay constant beyond this magnitude, which is close to the limit of
// float32.
inline constexpr double kMostField = 1e37;

using base::value_of;

// Returns the result of the same operator with its operands exchanged.
template <class T>
Binary<T> exchanged(const Binary<T>& b) {
  return {b.g, b.g2, b.g1};
}

}  // namespace isofield::operators
