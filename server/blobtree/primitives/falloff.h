// soften() gives the field of a positive primitive at a signed distance (scene.proto, Primitives). It falls off to 0 at
// the range.
#pragma once

#include <algorithm>
#include <cmath>

namespace isofield::blobtree {

inline constexpr double kR0 = 0.45420201894740647;  // sqrt(1 - 2^(-1/3)), where the falloff w is 0.5

// Returns w(clamp(r0 + (1 - r0) d / range, 0, 1)) with w(r) = (1 - r^2)^3, at the signed distance d.
template <class T>
T soften(const T& d, double range) {
  using std::max, std::min;
  const T r = min(max(d * ((1 - kR0) / range) + kR0, T(0.0)), T(1.0));
  const T v = T(1.0) - r * r;
  return v * v * v;
}

}  // namespace isofield::blobtree
