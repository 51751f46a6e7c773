// Dual is a number with its derivatives with respect to the three coordinates of a point. Formulas that are evaluated
// with it yield their exact gradients (forward automatic differentiation of first order).
#pragma once

#include <cmath>

#include "blobtree/geometry/vec3.h"
#include "reference/vec3.h"

namespace isofield::reference {

struct Dual {
  double v = 0;
  blobtree::dvec3 d;

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: constants mix with duals as numbers do
  Dual(double value, const blobtree::dvec3& derivative) : v(value), d(derivative) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator-(const Dual& a) { return {-a.v, a.d * -1.0}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.d * b.v + b.d * a.v}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double g = a.v / b.v;
    return {g, (a.d - b.d * g) * (1 / b.v)};
  }
  bool operator==(const Dual&) const = default;
};

inline double value_of(const Dual& a) {
  return a.v;
}

// Returns f(a) for a function that has the value f and the derivative slope at a.
inline Dual chain(const Dual& a, double f, double slope) {
  return {f, a.d * slope};
}

// The derivative at 0 does not exist; 0 stands for it.
inline Dual sqrt(const Dual& a) {
  if (a.v <= 0) return 0;
  const double root = std::sqrt(a.v);
  return chain(a, root, 0.5 / root);
}
inline Dual reciprocal(const Dual& a) {
  return chain(a, 1 / a.v, -1 / (a.v * a.v));
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.v * x.v + y.v * y.v;
  return {std::atan2(y.v, x.v), y.d * (x.v / square) - x.d * (y.v / square)};
}

// Requires a >= 0. The result at 0 is 0 with the derivative 0, which is right for exponents above 1.
inline Dual pow(const Dual& a, double exponent) {
  if (a.v <= 0) return 0;
  return chain(a, std::pow(a.v, exponent), exponent * std::pow(a.v, exponent - 1));
}

using DualVec3 = Vec3<Dual>;

inline DualVec3 cross(const DualVec3& a, const DualVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace isofield::reference
