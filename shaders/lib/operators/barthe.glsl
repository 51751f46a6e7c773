// Barthe's blend, [G] eqs. 12 and 13. Mirrors server/operators/barthe.h.
#ifndef BARTHE_GLSL
#define BARTHE_GLSL

#include "joining.glsl"
#include "steering.glsl"

// Returns the blend with t1 = tan(theta1) and t2 = tan(theta2).
Binary barthe_blend(Dual f1, Dual f2, float t1, float t2) {
  bool swap = value_of(f1) < value_of(f2);
  Dual hi = select_dual(f1, f2, swap), lo = select_dual(f2, f1, swap);
  float u1 = swap ? t2 : t1, u2 = swap ? t1 : t2;
  float i1 = 1.0 / max(1.0 - u1, 1e-6), i2 = 1.0 / max(1.0 - u2, 1e-6);
  float tau1 = u1 * i1, tau2 = u2 * i2;
  Dual q0 = i1 * (lo - u1 * hi);
  Dual b = (1.0 + tau2) * hi + tau1 * q0;
  Dual qq = times(q0, q0);
  Dual divisor = b + square_root(times(b, b) - (tau1 * tau1 + tau2 * tau2 - 1.0) * qq);
  Dual above = over(qq, select_dual(divisor, dual(1.0), value_of(divisor) <= 1e-20));
  Dual c = hi + above;
  Dual p = hi - tau2 * above, q = q0 - tau1 * above;
  Dual slope = tau2 * p + tau1 * q + c;
  Dual inverse = reciprocal(select_dual(slope, dual(1.0), value_of(slope) <= 1e-20));
  Binary r = Binary(c, i2 * times(p, inverse), i1 * times(q, inverse));
  r = select_binary(r, Binary(lo, dual(0.0), dual(1.0)), value_of(hi) <= u2 * value_of(lo));
  r = select_binary(r, Binary(hi, dual(1.0), dual(0.0)), value_of(lo) <= u1 * value_of(hi));
  return select_binary(r, exchanged(r), swap);
}

Field unite_barthe(Field a, Field b, uint record, Angle angle) {
  vec4 o = operation_at(record);
  return join_positive(a, b, barthe_blend(dual_of(a), dual_of(b), o.x, o.y));
}

#endif
