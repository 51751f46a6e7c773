// Half-spaces. Mirrors server/blobtree/primitives/half_space.h.
#ifndef HALF_SPACE_GLSL
#define HALF_SPACE_GLSL

#include "distance.glsl"

Field half_space_field(vec3 p, uint record) {
  Pair plane = leaf_pair_at(record);
  Distance s;
  s.d = dot(plane.b.xyz, p - plane.a.xyz);
  s.n = plane.b.xyz;
#ifdef WITH_GRADIENT
  s.h = mat3(0.0);
#endif
  return soften(s, plane.a.w);
}

#endif
