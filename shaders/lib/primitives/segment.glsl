// Round cones (segments). Mirrors server/blobtree/primitives/segment.h.
#ifndef SEGMENT_GLSL
#define SEGMENT_GLSL

#include "primitives/sphere.glsl"

// The distance to a round cone from the origin along the unit vector `axis`. It is the distance to the nearest of the
// spheres that span the cone.
Distance segment_distance(vec3 v, vec3 axis, float len, float radius, float slope, float tan_tilt) {
  float y = dot(v, axis);
  vec3 across = v - y * axis;
  float rho = length(across);
  float c = y - rho * tan_tilt;
  float foot = clamp(c, 0.0, len);
  Distance s = sphere_distance(v - foot * axis, radius + slope * foot);
#ifdef WITH_GRADIENT
  // The distance does not curve along a straight line of the cone (a generatrix), so that part of the sphere's
  // curvature is removed.
  bool on_cone = c > 0.0 && c < len;
  vec3 t = (axis + slope * s.n) * inversesqrt(max(1.0 - slope * slope, 1e-12));
  float m = length(v - foot * axis);
  s.h -= (on_cone ? safe_inverse(m) : 0.0) * outerProduct(t, t);
#endif
  return s;
}

Field segment_field(vec3 p, uint record) {
  Pair line = leaf_pair_at(record);
  vec4 cone = leaf_at(record + 2u);
  return soften(segment_distance(p - line.a.xyz, line.b.xyz, line.b.w, cone.x, cone.y, cone.z), line.a.w);
}

Field affine_segment_field(vec3 p, uint record) {
  Placement at = place(p, record);
  float slope = at.size.z;
  float tan_tilt = -slope * inversesqrt(max(1.0 - slope * slope, 1e-12));
  return placed_field(at, segment_distance(at.q, vec3(0.0, 0.0, 1.0), at.size.x, at.size.y, slope, tan_tilt));
}

#endif
