// Spheres, and ellipsoids, which are spheres under an affine map. Mirrors
// server/blobtree/primitives/{sphere,ellipsoid}.h.
#ifndef SPHERE_GLSL
#define SPHERE_GLSL

#include "distance.glsl"

// The distance to a sphere around the origin.
Distance sphere_distance(vec3 v, float radius) {
  Distance s;
  float m = length(v);
  float inverse_m = safe_inverse(m);
  s.d = m - radius;
  s.n = v * inverse_m;
#ifdef WITH_GRADIENT
  s.h = inverse_m * (mat3(1.0) - outerProduct(s.n, s.n));
#endif
  return s;
}

Field sphere_field(vec3 p, uint record) {
  Pair sphere = leaf_pair_at(record);
  return soften(sphere_distance(p - sphere.a.xyz, sphere.b.x), sphere.a.w);
}

Field ellipsoid_field(vec3 p, uint record) {
  Placement at = place(p, record);
  return placed_field(at, sphere_distance(at.q, at.size.x));
}

#endif
