// Jet is a number with its first and second derivatives with respect to the three coordinates of a point (forward
// automatic differentiation of second order). The distances and the falloff of primitives are evaluated with it.
#pragma once

#include <array>
#include <cmath>

namespace isofield::reference {

struct Jet {
  double v = 0;
  std::array<double, 3> d{};                 // gradient
  std::array<std::array<double, 3>, 3> h{};  // Hessian

  Jet() = default;
  Jet(double value) : v(value) {}  // NOLINT: constants mix with jets as numbers do

  // Returns f(a, b) for a function that has the value f and these partial derivatives at (a, b).
  static Jet chain(const Jet& a, const Jet& b, double f, double fa, double fb, double faa, double fab, double fbb) {
    Jet r(f);
    for (int i = 0; i < 3; ++i) {
      r.d[i] = fa * a.d[i] + fb * b.d[i];
      for (int j = 0; j < 3; ++j) {
        r.h[i][j] = fa * a.h[i][j] + fb * b.h[i][j] + faa * a.d[i] * a.d[j] + fbb * b.d[i] * b.d[j] +
                    fab * (a.d[i] * b.d[j] + b.d[i] * a.d[j]);
      }
    }
    return r;
  }

  friend Jet operator+(const Jet& a, const Jet& b) { return chain(a, b, a.v + b.v, 1, 1, 0, 0, 0); }
  friend Jet operator-(const Jet& a, const Jet& b) { return chain(a, b, a.v - b.v, 1, -1, 0, 0, 0); }
  friend Jet operator*(const Jet& a, const Jet& b) { return chain(a, b, a.v * b.v, b.v, a.v, 0, 1, 0); }
};

inline double value_of(const Jet& a) {
  return a.v;
}

// The derivatives at 0 do not exist; 0 stands for them. The same holds so close to 0 that the third power of the root
// would vanish.
inline Jet sqrt(const Jet& a) {
  if (a.v <= 1e-60) return std::sqrt(a.v > 0 ? a.v : 0);
  const double root = std::sqrt(a.v);
  return Jet::chain(a, a, root, 0.5 / root, 0, -0.25 / (a.v * root), 0, 0);
}
inline Jet abs(const Jet& a) {
  return a.v < 0 ? Jet(0.0) - a : a;
}
// If both are equal, the first one is taken.
inline Jet max(const Jet& a, const Jet& b) {
  return a.v >= b.v ? a : b;
}
inline Jet min(const Jet& a, const Jet& b) {
  return a.v <= b.v ? a : b;
}

}  // namespace isofield::reference
