// Numerical derivatives by differences. Tests compare exact derivatives with them.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace isofield::test_support {

// f'(x) by central differences of fourth order with steps h and 2 h.
template <class Function>
double slope(const Function& f, double x, double h) {
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

// Computes the same slope, but only where two step sizes agree to `tolerance` (relative, or absolute below 1). Returns
// nothing where f has a kink within 2 h of x, or bends too much for differences.
template <class Function>
std::optional<double> settled_slope(const Function& f, double x, double h, double tolerance) {
  const double coarse = slope(f, x, h), fine = slope(f, x, h / 3);
  if (!(std::abs(coarse - fine) <= tolerance * std::max(1.0, std::abs(fine)))) return std::nullopt;
  return fine;
}

}  // namespace isofield::test_support
