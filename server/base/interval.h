// Intervals of numbers. They are computed in double precision and padded, so that they also hold what the device
// computes in float32.
#pragma once

#include <algorithm>
#include <cmath>

namespace isofield::base {

struct Interval {
  double lo = 0, hi = 0;
};

// A float32 result of size 1 differs from the exact one by at most this.
inline constexpr double kValueRoom = 4e-6;

// Returns the interval from lo to hi with room for rounding, in proportion to its larger end, on both sides.
inline Interval padded(double lo, double hi) {
  const double room = kValueRoom * std::max({std::abs(lo), std::abs(hi), 1e-3});
  return {lo - room, hi + room};
}

}  // namespace isofield::base
