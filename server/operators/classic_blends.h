// The operators of `positive` fields that [G] compares itself with (section 2): eqs. 9 to 13 and Bernhardt's. Fields
// are not negative; where one is 0 every operator returns the other.
#pragma once

#include <algorithm>
#include <utility>

#include "operators/binary.h"
#include "operators/root.h"

namespace isofield::operators {

// [G] eq. 11, t >= 1: (f1^t + f2^t)^(1/t), with the larger field taken out so that no power under- or overflows.
template <class T>
Binary<T> ricci(const T& f1, const T& f2, double t) {
  using std::pow;
  if (value_of(f2) <= 0) return {f1, T(1.0), T(0.0)};
  if (value_of(f1) <= 0) return {f2, T(0.0), T(1.0)};
  if (value_of(f1) < value_of(f2)) return exchanged(ricci(f2, f1, t));
  const T g = f1 * pow(pow(f2 / f1, t) + T(1.0), 1 / t);
  return {g, pow(f1 / g, t - 1), pow(f2 / g, t - 1)};
}

// The centre k(C) of the arc at level C of the clean union ([G] eq. 10), with k'(C).
template <class T>
std::pair<T, T> clean_union_centre(const T& c) {
  using std::sqrt;
  if (value_of(c) <= 0.5) return {c * c * T(2.0), c * T(4.0)};
  const T k = sqrt(c * T(0.5));
  return {k, T(0.25) / k};
}

// Barthe's clean union, [G] eqs. 9 and 10: at level C a quarter of a circle around (k(C), k(C)), of radius C - k(C).
template <class T>
Binary<T> clean_union(const T& f1, const T& f2) {
  using std::sqrt;
  if (value_of(f1) < value_of(f2)) return exchanged(clean_union(f2, f1));
  const double hi = value_of(f1), lo = value_of(f2);
  // At the edge, where the arcs have no radius, and outside of them.
  const double centre = clean_union_centre(hi).first;
  if (lo <= centre || hi - centre <= 1e-12 * hi) return {f1, T(1.0), T(0.0)};
  const double root = root_of(hi, lo < 0.5 ? std::sqrt(lo / 2) : 2 * lo * lo, [&](double c) {
    const auto [k, k_c] = clean_union_centre(c);
    const double a = hi - k, b = std::max(lo - k, 0.0), m = std::hypot(a, b);
    return std::pair{c - k - m, 1 - k_c * (1 - (a + b) / m)};
  });
  // A Newton step in T from the root gives its derivatives; the slope needs none of its own for that.
  T c = root;
  T slope = 1.0;
  for (int step = 0; step < 2; ++step) {
    const auto [k, k_c] = clean_union_centre(c);
    const T a = f1 - k, b = f2 - k;
    const T m = sqrt(a * a + b * b);
    slope = T(1.0) - k_c * (T(1.0) - (a + b) / m);
    if (step == 0) c = c - (c - k - m) * T(1 / value_of(slope));
  }
  const T k = clean_union_centre(c).first;
  const T denominator = (c - k) * slope;
  return {c, (f1 - k) / denominator, (f2 - k) / denominator};
}

// Barthe's blend, [G] eqs. 12 and 13: between the lines at theta1 from the f1 axis and theta2 from the f2 axis level
// curves are elliptical arcs: the one at level C lies around C (t2, t1) with semi-axes C (1 - t2) and C (1 - t1), where
// t = tan(theta). A quadratic in C, written in what C is above the greater field, so that nothing cancels where the
// lines are close to each other.
template <class T>
Binary<T> barthe_blend(const T& f1, const T& f2, double t1, double t2) {
  using std::sqrt;
  if (value_of(f1) < value_of(f2)) return exchanged(barthe_blend(f2, f1, t2, t1));
  if (value_of(f2) <= t1 * value_of(f1)) return {f1, T(1.0), T(0.0)};
  if (value_of(f1) <= t2 * value_of(f2)) return {f2, T(0.0), T(1.0)};
  const double s1 = std::max(1 - t1, 1e-6), s2 = std::max(1 - t2, 1e-6);
  const double tau1 = t1 / s1, tau2 = t2 / s2;
  const T q0 = (f2 - f1 * T(t1)) * T(1 / s1);
  const T b = f1 * T(1 + tau2) + q0 * T(tau1);
  const T above = q0 * q0 / (b + sqrt(b * b - q0 * q0 * T(tau1 * tau1 + tau2 * tau2 - 1)));
  const T c = f1 + above;
  const T p = f1 - above * T(tau2), q = q0 - above * T(tau1);
  const T slope = p * T(tau2) + q * T(tau1) + c;
  return {c, p / slope * T(1 / s2), q / slope * T(1 / s1)};
}

// Bernhardt's interpolation between the clean union (weight 0) and Barthe's blend (weight 1).
template <class T>
Binary<T> bernhardt_blend(const T& f1, const T& f2, double t1, double t2, double weight) {
  const Binary<T> u = clean_union(f1, f2), b = barthe_blend(f1, f2, t1, t2);
  const T v(1 - weight), w(weight);
  return {u.g * v + b.g * w, u.g1 * v + b.g1 * w, u.g2 * v + b.g2 * w};
}

}  // namespace isofield::operators
