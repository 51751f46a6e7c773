// Tori. Mirrors server/blobtree/primitives/torus.h.
#ifndef TORUS_GLSL
#define TORUS_GLSL

#include "distance.glsl"

Distance torus_distance(vec3 q, float major, float minor) {
  float rho = length(q.xy);
  vec2 w = vec2(rho - major, q.z);
  float m = length(w);
  float inverse_m = safe_inverse(m);
  return revolve(q, rho, m - minor, w * inverse_m, inverse_m);
}

Field torus_field(vec3 p, uint record) {
  Placement at = place(p, record);
  return placed_field(at, torus_distance(at.q, at.size.x, at.size.y));
}

#endif
