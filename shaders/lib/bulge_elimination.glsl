// Bulge elimination of [H] section 5, which narrows a blend's ranges where surfaces are aligned. Mirrors
// server/operators/bulge_elimination.h.
#ifndef BULGE_ELIMINATION_GLSL
#define BULGE_ELIMINATION_GLSL

#include "dual.glsl"
#include "steering.glsl"

// The ranges and weights of two operands.
struct Reach2 {
  Dual r1, r2, m1, m2;
};

// Returns range (1 - cos(angle) + omega). `versine` is 1 - cos(angle).
Dual angular_range(float range, Dual versine, float omega) { return range * (dual(omega) + versine); }

// Changes ranges and weights as [H] section 5 says. The caller has clamped `ratio`, the first gradient's length over
// the second's, to [1 / MOST_RATIO, MOST_RATIO].
void eliminate_bulge(inout Reach2 reach, Dual cosine, Dual versine, Dual ratio, float omega) {
  reach.r1 = angular_range(value_of(reach.r1), versine, omega);
  reach.r2 = angular_range(value_of(reach.r2), versine, omega);
  Dual m1 = reach.m1, m2 = reach.m2;
  bool is_aligned = value_of(cosine) > 0.0;
  bool first_leads = value_of(m1) > value_of(m2) * value_of(ratio);
  reach.m2 = select_dual(m2, m2 + times(over(m1, ratio) - m2, cosine), is_aligned && first_leads);
  reach.m1 = select_dual(m1, m1 + times(times(m2, ratio) - m1, cosine), is_aligned && !first_leads);
}

#endif
