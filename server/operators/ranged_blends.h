// The operators of [H] on `signed` fields (negative inside): blends whose every operand keeps its own range r_i in this
// blend and its own weight m_i, the multiple of a later blend's range that it is met with. Each is the root h of
// H(x_1 - m_1 h, ..., x_k - m_k h) = 0, so that the zero set does not depend on the weights.
#pragma once

#include <algorithm>
#include <vector>

#include "operators/binary.h"

namespace isofield::operators {

// What a blend of two operands uses of one of them; numbers, since bulge elimination makes them follow the fields.
template <class T>
struct Reach {
  T range, weight;
};

// [H] eq. 4, p < r1 r2. Written from the left end of the bracket that the paper gives, h = low + delta, where the
// quadratic has c < 0 < b and delta a stable form; the operands there, y_i, are positive just in the blending region
// II.
template <class T>
Binary<T> bt2(const T& x1, const T& x2, const Reach<T>& reach1, const Reach<T>& reach2, const T& p) {
  using std::sqrt;
  const T &r1 = reach1.range, &r2 = reach2.range, &m1 = reach1.weight, &m2 = reach2.weight;
  const T spread = r1 * m2 + r2 * m1;
  const T lead = m2 * x1 - m1 * x2;
  const T y1 = r1 * (lead + m1 * r2) / spread, y2 = r2 * (m2 * r1 - lead) / spread;
  const T i1 = T(1.0) / m1, i2 = T(1.0) / m2;
  if (value_of(y1) <= 0) return {x1 * i1, i1, T(0.0)};
  if (value_of(y2) <= 0) return {x2 * i2, T(0.0), i2};
  const T low = (r1 * x2 + r2 * x1 - r1 * r2) / spread;
  const T k = r1 * r2 - p;
  const T b = T(2.0) * k * (m1 * y2 + m2 * y1);
  const T a = spread * spread - T(2.0) * k * m1 * m2;
  const T slope = sqrt(b * b + T(8.0) * a * k * y1 * y2);  // W_h at the root
  const T delta = T(4.0) * k * y1 * y2 / (b + slope);
  const T common = T(2.0) * spread * delta;
  return {low + delta, (common * r2 + T(2.0) * k * (y2 - m2 * delta)) / slope,
          (common * r1 + T(2.0) * k * (y1 - m1 * delta)) / slope};
}

// [H] eq. 5: the root h of sum_i [(r_i - x_i + m_i h) / r_i]_+^p_i = 1. The sum is convex and increasing in h and at
// least 1 at min x_i / m_i, so Newton's method from there falls to the root and never beyond it: no bracket is needed
// (the paper uses Regula Falsi). `powers` are p_i > 1. Returns h and its partials.
template <class T>
struct Rooted {
  T g;
  std::vector<T> partials;
};
template <class T>
Rooted<T> btk(const std::vector<T>& x, const std::vector<Reach<T>>& reach, const std::vector<double>& powers) {
  using std::pow;
  const std::size_t k = x.size();
  std::size_t least = 0;
  for (std::size_t i = 1; i < k; ++i) {
    if (value_of(x[i]) / value_of(reach[i].weight) < value_of(x[least]) / value_of(reach[least].weight)) least = i;
  }
  double h = value_of(x[least]) / value_of(reach[least].weight);
  const auto bracket = [&](std::size_t i, double h) {
    return (value_of(reach[i].range) - value_of(x[i]) + value_of(reach[i].weight) * h) / value_of(reach[i].range);
  };
  bool is_blend = false;
  for (std::size_t i = 0; i < k; ++i) is_blend |= i != least && bracket(i, h) > 0;
  const T inverse = T(1.0) / reach[least].weight;
  Rooted<T> r{x[least] * inverse, std::vector<T>(k, T(0.0))};
  if (!is_blend) {
    r.partials[least] = inverse;
    return r;
  }
  double slope = 0;
  for (int step = 0; step < 60; ++step) {
    double excess = -1;
    slope = 0;
    for (std::size_t i = 0; i < k; ++i) {
      const double t = bracket(i, h);
      if (t <= 0) continue;
      excess += std::pow(t, powers[i]);
      slope += powers[i] * std::pow(t, powers[i] - 1) * value_of(reach[i].weight) / value_of(reach[i].range);
    }
    const double next = h - excess / slope;
    if (!(next < h)) break;
    h = next;
  }
  // A Newton step in T gives the root's derivatives, a second pass the partials with theirs.
  r.g = T(h);
  for (int pass = 0; pass < 2; ++pass) {
    T excess(-1.0), total(0.0);
    for (std::size_t i = 0; i < k; ++i) {
      const T t = (reach[i].range - x[i] + reach[i].weight * r.g) / reach[i].range;
      if (value_of(t) <= 0) {
        r.partials[i] = T(0.0);
        continue;
      }
      excess = excess + pow(t, powers[i]);
      r.partials[i] = pow(t, powers[i] - 1) * T(powers[i]) / reach[i].range;
      total = total + r.partials[i] * reach[i].weight;
    }
    if (pass == 0) {
      r.g = r.g - excess * T(1 / slope);
    } else {
      for (T& partial : r.partials) partial = partial / total;
    }
  }
  return r;
}

// [H] section 5: ranges and weights of two operands that follow the cosine of the angle between their gradients and the
// ratio |grad x1| / |grad x2|, so that aligned surfaces do not bulge. The ratio is 1 of distances; it is kept within
// [1 / kMostRatio, kMostRatio], so that a weight is never more than so many times another.
inline constexpr double kMostRatio = 8;
template <class T>
T angular_range(double range, const T& cosine, double omega) {
  return (T(1 + omega) - cosine) * T(range);
}
template <class T>
void eliminate_bulge(Reach<T>& reach1, Reach<T>& reach2, const T& cosine, const T& ratio, double omega) {
  reach1.range = angular_range(value_of(reach1.range), cosine, omega);
  reach2.range = angular_range(value_of(reach2.range), cosine, omega);
  if (value_of(cosine) <= 0) return;
  const T m1 = reach1.weight, m2 = reach2.weight;
  if (value_of(m1) > value_of(m2) * value_of(ratio)) {
    reach2.weight = m2 + (m1 / ratio - m2) * cosine;
  } else {
    reach1.weight = m1 + (m2 * ratio - m1) * cosine;
  }
}

}  // namespace isofield::operators
