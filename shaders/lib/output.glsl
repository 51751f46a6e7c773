// Writes the results of points and grids: the field, 1 number a point, or the field and its gradient, 4 numbers a
// point.
#ifndef OUTPUT_GLSL
#define OUTPUT_GLSL

#include "bindings.glsl"
#include "field.glsl"

#ifdef WITH_GRADIENT
layout(std430, binding = BINDING_POINTS_RESULTS) writeonly buffer Results { vec4 results[]; };
#else
layout(std430, binding = BINDING_POINTS_RESULTS) writeonly buffer Results { float results[]; };
#endif

void write_result(uint place, Field a) {
#ifdef WITH_GRADIENT
  vec3 g = field_gradient(a);
  g = mix(g, vec3(0.0), equal(g, vec3(0.0)));  // turns -0 into 0, since clients should not see a difference
  results[place] = vec4(a.f, g);
#else
  results[place] = a.f;
#endif
}

#endif
