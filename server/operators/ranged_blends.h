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

// [H] eq. 4 in a form without cancellation. With X_i = x_i / m_i and R_i = r_i / m_i it is the blend of weights 1; of p
// it needs only the tightness 1 - p / (r1 r2), so that a conic keeps its shape where the ranges follow an angle. The
// result depends on where X1 - X2 lies between -R2 and R1, beyond which one operand makes it alone: at s within ]0, 1[.
// There q1 + q2 = 1, off = q1 - q2, and rho is the root of the quadratic's discriminant over what it is at p = r1 r2.
template <class T>
Binary<T> bt2(const T& x1, const T& x2, const Reach<T>& reach1, const Reach<T>& reach2, double tightness) {
  using std::sqrt;
  const T i1 = T(1.0) / reach1.weight, i2 = T(1.0) / reach2.weight;
  const T X1 = x1 * i1, X2 = x2 * i2;
  const T R1 = reach1.range * i1, R2 = reach2.range * i2;
  const T per_length = T(1.0) / (R1 + R2);
  const T share1 = R1 * per_length, share2 = R2 * per_length;
  const T apart = (X1 - X2) * per_length;
  const T s1 = share2 + apart, s2 = share1 - apart;  // s and 1 - s
  if (value_of(s1) <= 0) return {X1, i1, T(0.0)};
  if (value_of(s2) <= 0) return {X2, T(0.0), i2};
  const T per_whole = T(1.0) / (share2 * s2 + share1 * s1);
  const T part1 = s1 * per_whole, part2 = s2 * per_whole;
  const T q1 = share2 * part2, q2 = share1 * part1, off = T(0.0) - apart * per_whole;
  const T bend(2 / tightness), product = bend * part1 * part2;
  const T rho = sqrt(off * off + product);
  // rho + off and rho - off, the lesser of them by their product.
  const T greater = rho + (value_of(off) < 0 ? T(0.0) - off : off), lesser = product / greater;
  const T &above = value_of(off) < 0 ? lesser : greater, &below = value_of(off) < 0 ? greater : lesser;
  const T per_root = T(1.0) / (T(1.0) + rho), scale = per_root / rho;
  // Below either operand by what is the same; from the lesser one, whose part is the smaller.
  const T g = value_of(apart) < 0 ? X1 - R1 * s1 * below * per_root : X2 - R2 * s2 * above * per_root;
  return {g, q1 * (bend * part1 + above) * scale * i1, q2 * (bend * part2 + below) * scale * i2};
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
