// The sum of two fields. Mirrors server/operators/sum.h.
#ifndef SUM_GLSL
#define SUM_GLSL

#include "steering.glsl"

Field unite_sum(Field a, Field b, uint record, Angle angle) {
  a.f += b.f;
  a.d += b.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    a.g += b.g;
    a.j += b.j;
  }
#endif
  return a;
}

#endif
