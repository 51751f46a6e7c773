// Where results of points and grids go: 1 or 4 numbers a point.
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
  g = mix(g, vec3(0.0), equal(g, vec3(0.0)));  // one zero: a -0 means nothing to a client
  results[place] = vec4(a.f, g);
#else
  results[place] = a.f;
#endif
}

#endif
