// The maximum of two fields. Mirrors server/operators/max.h.
#ifndef MAX_GLSL
#define MAX_GLSL

#include "sharp_union.glsl"
#include "steering.glsl"

Field unite_max(Field a, Field b, uint record, Angle angle) { return sharp_union(a, b, b.f > a.f); }

#endif
