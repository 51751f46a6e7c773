// What the distance of a primitive is, and how it becomes a field. Each kind has a file in primitives/.
#ifndef DISTANCE_GLSL
#define DISTANCE_GLSL

#include "domain.glsl"
#include "field.glsl"

// Coordinates beyond this would overflow when they are squared. Fields are constant beyond it.
const float FARTHEST = 1e10;
vec3 within_reach(vec3 point) { return clamp(point, vec3(-FARTHEST), vec3(FARTHEST)); }

// A distance with its gradient and Hessian, in whatever frame.
struct Distance {
  float d;
  vec3 n;
#ifdef WITH_GRADIENT
  mat3 h;
#endif
};

float safe_inverse(float x) { return x > 1e-18 ? 1.0 / x : 0.0; }

// A signed primitive's field: the distance times minus the (negative) slope.
Field signed_field(Distance s, float slope) {
  Field a = zero_field();
  a.f = -slope * s.d;
  a.d = -slope * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    a.g = a.d;
    a.j = -slope * s.h;
  }
#endif
  return a;
}

// f = w(clamp(R0 + slope d, 0, 1)), w(r) = (1 - r^2)^3.
Field soften(Distance s, float slope) {
  if (has_signed_leaves() && slope < 0.0) return signed_field(s, slope);
  Field a = zero_field();
  float r = clamp(R0 + slope * s.d, 0.0, 1.0);
  float v = 1.0 - r * r;
  a.f = v * v * v;
  float w1 = -6.0 * r * v * v * slope;  // r = 0 and r = 1 give 0
  a.d = w1 * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    float w2 = r > 0.0 ? -6.0 * v * (1.0 - 5.0 * r * r) * slope * slope : 0.0;
    a.g = a.d;
    a.j = w1 * s.h + w2 * outerProduct(s.n, s.n);
  }
#endif
  return a;
}

// A body of revolution around z from its profile in the (rho, z) half plane: distance, unit normal (n_rho, n_z) and
// curvature of the profile's level line.
Distance revolve(vec3 q, float rho, float d, vec2 n, float curvature) {
  Distance s;
  float inverse_rho = safe_inverse(rho);
  vec3 radial = vec3(q.xy * inverse_rho, 0.0);
  s.d = d;
  s.n = vec3(n.x * radial.xy, n.y);
#ifdef WITH_GRADIENT
  vec3 around = vec3(-radial.y, radial.x, 0.0);
  vec3 along = vec3(-n.y * radial.xy, n.x);
  s.h = curvature * outerProduct(along, along) + n.x * inverse_rho * outerProduct(around, around);
#endif
  return s;
}

Field placed_field(Placement at, Distance s) {
  s.n = at.to_world * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) s.h = at.to_world * s.h * transpose(at.to_world);
#endif
  return soften(s, at.slope);
}

#endif
