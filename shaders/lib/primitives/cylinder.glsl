// Cylinders with flat ends. Mirrors server/blobtree/primitives/cylinder.h.
#ifndef CYLINDER_GLSL
#define CYLINDER_GLSL

#include "distance.glsl"

Distance cylinder_distance(vec3 q, float half_length, float radius) {
  float rho = length(q.xy);
  vec2 e = vec2(rho - radius, abs(q.z) - half_length);
  float z_sign = q.z < 0.0 ? -1.0 : 1.0;
  bool corner = e.x > 0.0 && e.y > 0.0;
  float m = length(e);
  float inverse_m = corner ? safe_inverse(m) : 0.0;
  vec2 face = e.x > e.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
  vec2 n = corner ? e * inverse_m : face;
  return revolve(q, rho, corner ? m : max(e.x, e.y), vec2(n.x, n.y * z_sign), inverse_m);
}

Field cylinder_field(vec3 p, uint record) {
  Placement at = place(p, record);
  return placed_field(at, cylinder_distance(at.q, at.size.x, at.size.y));
}

#endif
