// Differences of positive fields, mirroring server/operators/difference.h. Differences of signed fields are minima of
// complements.
#ifndef DIFFERENCE_GLSL
#define DIFFERENCE_GLSL

#include "sharp_union.glsl"
#include "steering.glsl"

// Returns max(0, min(a, 1 - b)).
Field subtract(Field a, Field b) {
  b.f = 1.0 - b.f;
  b.d = -b.d;
#ifdef WITH_GRADIENT
  b.g = -b.g;
  b.j = -b.j;
#endif
  Field r = sharp_union(a, b, b.f < a.f);
  return select_field(r, zero_field(), r.f <= 0.0);
}

Field unite_subtract(Field a, Field b, uint record, Angle angle) { return subtract(a, b); }
Field unite_subtract_from(Field a, Field b, uint record, Angle angle) { return subtract(b, a); }

#endif
