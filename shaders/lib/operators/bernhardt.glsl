// Bernhardt's operator, a weighted mean of the clean union and Barthe's blend. Mirrors server/operators/bernhardt.h.
#ifndef BERNHARDT_GLSL
#define BERNHARDT_GLSL

#include "operators/barthe.glsl"
#include "operators/clean.glsl"

Binary bernhardt_blend(Dual f1, Dual f2, float t1, float t2, float weight) {
  Binary u = clean_union(f1, f2), b = barthe_blend(f1, f2, t1, t2);
  float v = 1.0 - weight;
  return Binary(v * u.g + weight * b.g, v * u.g1 + weight * b.g1, v * u.g2 + weight * b.g2);
}

Field unite_bernhardt(Field a, Field b, uint record, Angle angle) {
  vec4 o = operation_at(record);
  return join_positive(a, b, bernhardt_blend(dual_of(a), dual_of(b), o.x, o.y, o.z));
}

#endif
