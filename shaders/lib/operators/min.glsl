// The minimum of two fields. Mirrors server/operators/min.h.
#ifndef MIN_GLSL
#define MIN_GLSL

#include "sharp_union.glsl"
#include "steering.glsl"

Field unite_min(Field a, Field b, uint record, Angle angle) { return sharp_union(a, b, b.f < a.f); }

#endif
