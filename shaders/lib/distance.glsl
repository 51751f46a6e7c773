// The distance to a primitive, and the field that is made of it. The files in primitives/ compute the distance of each
// kind.
#ifndef DISTANCE_GLSL
#define DISTANCE_GLSL

#include "domain.glsl"
#include "field.glsl"

// The largest coordinate of a point: squares of larger ones could overflow. Fields are constant beyond it.
const float FARTHEST = 1e10;
vec3 within_reach(vec3 point) { return clamp(point, vec3(-FARTHEST), vec3(FARTHEST)); }

// A signed distance d with its gradient n and Hessian h, in any one frame.
struct Distance {
  float d;
  vec3 n;
#ifdef WITH_GRADIENT
  mat3 h;
#endif
};

float safe_inverse(float x) { return x > 1e-18 ? 1.0 / x : 0.0; }

// The field of a signed primitive: the distance times -slope. Records mark signed primitives by a negative slope.
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

// The field of a primitive: f = w(clamp(R0 + slope d, 0, 1)) with w(r) = (1 - r^2)^3, or that of a signed primitive.
Field soften(Distance s, float slope) {
  if (has_signed_leaves() && slope < 0.0) return signed_field(s, slope);
  Field a = zero_field();
  float r = clamp(R0 + slope * s.d, 0.0, 1.0);
  float v = 1.0 - r * r;
  a.f = v * v * v;
  float w1 = -6.0 * r * v * v * slope;  // 0 at r = 0 and r = 1
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

// The distance to a body of revolution around z, from its profile in the (rho, z) half plane: the distance d, the unit
// normal n = (n_rho, n_z), and the curvature of the profile's level line.
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
