// Boxes with rounded edges. Mirrors server/blobtree/primitives/box.h.
#ifndef BOX_GLSL
#define BOX_GLSL

#include "distance.glsl"

Distance box_distance(vec3 q, vec3 half_size, float rounding) {
  vec3 side = vec3(q.x < 0.0 ? -1.0 : 1.0, q.y < 0.0 ? -1.0 : 1.0, q.z < 0.0 ? -1.0 : 1.0);
  vec3 e = abs(q) - half_size;
  float deepest = max(e.x, max(e.y, e.z));
  vec3 outside = max(e, vec3(0.0));
  float m = length(outside);
  float inverse_m = safe_inverse(m);
  bool inside = deepest <= 0.0;
  vec3 face = e.x >= deepest ? vec3(1.0, 0.0, 0.0) : e.y >= deepest ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  Distance s;
  s.d = (inside ? deepest : m) - rounding;
  vec3 n = inside ? face : outside * inverse_m;
  s.n = n * side;
#ifdef WITH_GRADIENT
  vec3 alive = vec3(e.x > 0.0 ? 1.0 : 0.0, e.y > 0.0 ? 1.0 : 0.0, e.z > 0.0 ? 1.0 : 0.0);
  mat3 diagonal = mat3(alive.x, 0.0, 0.0, 0.0, alive.y, 0.0, 0.0, 0.0, alive.z);
  s.h = (inside ? 0.0 : inverse_m) * (diagonal - outerProduct(s.n, s.n));
#endif
  return s;
}

Field box_field(vec3 p, uint record) {
  Placement at = place(p, record);
  return placed_field(at, box_distance(at.q, at.size, leaf_at(record + 4u).x));
}

#endif
