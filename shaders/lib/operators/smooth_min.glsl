// The quadratic smooth minimum. Mirrors server/operators/smooth_min.h.
#ifndef SMOOTH_MIN_GLSL
#define SMOOTH_MIN_GLSL

#include "joining.glsl"
#include "parameters.glsl"
#include "steering.glsl"

Binary smooth_min(Dual x1, Dual x2, float radius, float inverse_radius) {
  bool swap = value_of(x2) < value_of(x1);
  Dual least = select_dual(x1, x2, swap), apart = select_dual(x2, x1, swap) - least;
  Dual h = dual(1.0) - inverse_radius * apart;
  h = select_dual(h, dual(0.0), value_of(h) <= 0.0);
  // If h is 0, the result is the lesser operand, to the bit.
  Binary r = Binary(least - (0.25 * radius) * times(h, h), dual(1.0) - 0.5 * h, 0.5 * h);
  return select_binary(r, exchanged(r), swap);
}

Field unite_smooth_min(Field a, Field b, uint record, Angle angle) {
  vec4 o = operation_at(record);
  return join_signed(a, b, smooth_min(dual_of(a), dual_of(b), o.x, o.y));
}

#endif
