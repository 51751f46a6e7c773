// The gradient-based composition operator, as a function of f1, f2 and t = tan(theta): [G] eqs. 17 to 24, solved by
// Newton's method on the homogeneous smooth maximum M. Mirrors server/operators/gradient_blend.h by name.
#ifndef GRADIENT_BLEND_GLSL
#define GRADIENT_BLEND_GLSL

#include "field.glsl"
#include "profiles.glsl"

// The boundary k(f) of [G] eqs. 17 and 18, with its partial derivatives by f and t.
struct Boundary {
  float k, k_f;
#ifdef WITH_GRADIENT
  float k_ff, k_t, k_ft;
#endif
};

Boundary boundary(float f, float t) {
  float s = max(1.0 - t, 1e-6);
  float x = 2.0 * (2.0 * f - t) / s;
  vec3 p = phi(x);
  bool linear = f <= 0.5 * t;
  float l = linear ? f : 0.25 * s * p.x + 0.5 * t;
  float l_f = linear ? 1.0 : p.y;
  float r = 1.0 / (1.0 + t);
  float c = 8.0 * t * r * r;
  bool flat_top = f >= 0.5;
  Boundary b;
  b.k = flat_top ? 0.5 * t : c * l * l;
  b.k_f = flat_top ? 0.0 : 2.0 * c * l * l_f;
#ifdef WITH_GRADIENT
  float x_t = 2.0 * (2.0 * f - 1.0) / (s * s);
  float l_ff = linear ? 0.0 : 4.0 * p.z / s;
  float l_t = linear ? 0.0 : 0.5 - 0.25 * p.x + 0.25 * s * p.y * x_t;
  float l_ft = linear ? 0.0 : p.z * x_t;
  float c_t = 8.0 * (1.0 - t) * r * r * r;
  b.k_ff = flat_top ? 0.0 : 2.0 * c * (l_f * l_f + l * l_ff);
  b.k_t = flat_top ? 0.5 : c_t * l * l + 2.0 * c * l * l_t;
  b.k_ft = flat_top ? 0.0 : 2.0 * c_t * l * l_f + 2.0 * c * (l_t * l_f + l * l_ft);
#endif
  return b;
}

// The value g with its partial derivatives with respect to f1, f2 and t.
struct Blend {
  float g, g1, g2;
#ifdef WITH_GRADIENT
  float gt, g11, g12, g22, g1t, g2t;
#endif
};

// `silhouette` is the place where the silhouette's table starts, or SMOOTH_SILHOUETTE.
Blend gradient_blend(float f1, float f2, float t, uint silhouette) {
  float hi = max(f1, f2), lo = min(f1, f2);
  // If lo <= k, the profile is taken at u = 0, M is exactly hi - k, and C stays hi: the result is the maximum, to the
  // bit.
  float c = hi;
  vec3 grading = silhouette_grading(silhouette);
  Boundary k;
  vec3 q;
  float a, u, rest, slope;
  // t is never negative, so the count is always 3; but the compiler cannot know that, and keeps a loop instead of
  // unrolling it. The loop ends when all lanes of a subgroup have left it: after one pass where the operator is the
  // maximum or F is linear (C >= 1/2), and mostly after two elsewhere. Measured, that is faster than always three
  // passes. The curvature of a table's profile has no bound beside a fold, so there the partials are right only if C is
  // exact (`near` is 0).
  int steps = t >= 0.0 ? 3 : 1;
  float near = silhouette == SMOOTH_SILHOUETTE ? 1e-6 : 0.0;
  for (int step = 0; step < steps; ++step) {
    k = boundary(c, t);
    a = max(hi - k.k, 1e-30);
    // A table needs w = 1 - u without cancellation. In both cases u is exactly 0 where lo <= k.
    float w = min((hi - lo) / a, 1.0);
    u = silhouette == SMOOTH_SILHOUETTE ? clamp((lo - k.k) / a, 0.0, 1.0) : 1.0 - w;
    q = silhouette_profile(silhouette, grading, u, w);
    rest = 1.0 - (q.x + (1.0 - u) * q.y);
    slope = 1.0 - k.k_f * rest;
    // A step of Newton's method on F(C) = C - k - M. The last pass also has the partials at the root, to 3 times
    // `near`.
    float off = ((c - hi) + a * (1.0 - q.x)) / slope;
    c -= off;
    if (abs(off) <= near || min(c, c + off) >= 0.5) break;
  }
  float m_hi = q.x - u * q.y, m_lo = q.y;
  float inverse = 1.0 / slope;
  bool exchanged = f1 < f2;
  Blend b;
  b.g = c;
  float g_hi = m_hi * inverse, g_lo = m_lo * inverse;
  b.g1 = exchanged ? g_lo : g_hi;
  b.g2 = exchanged ? g_hi : g_lo;
#ifdef WITH_GRADIENT
  b.gt = k.k_t * rest * inverse;
  // The total derivatives of g_hi and g_lo along hi, lo and t, by the implicit function theorem.
  vec3 k_v = vec3(k.k_f * g_hi, k.k_f * g_lo, k.k_f * b.gt + k.k_t);
  vec3 kf_v = vec3(k.k_ff * g_hi, k.k_ff * g_lo, k.k_ff * b.gt + k.k_ft);
  vec3 hi_v = vec3(1.0, 0.0, 0.0) - k_v;
  vec3 lo_v = vec3(0.0, 1.0, 0.0) - k_v;
  vec3 u_v = (lo_v - u * hi_v) / a;
  vec3 m_lo_v = q.z * u_v;
  vec3 m_hi_v = -u * m_lo_v;
  vec3 slope_v = -kf_v * rest + k.k_f * (m_hi_v + m_lo_v);
  vec3 g_hi_v = (m_hi_v - g_hi * slope_v) * inverse;
  vec3 g_lo_v = (m_lo_v - g_lo * slope_v) * inverse;
  b.g11 = exchanged ? g_lo_v.y : g_hi_v.x;
  b.g12 = g_hi_v.y;
  b.g22 = exchanged ? g_hi_v.x : g_lo_v.y;
  b.g1t = exchanged ? g_lo_v.z : g_hi_v.z;
  b.g2t = exchanged ? g_hi_v.z : g_lo_v.z;
#endif
  return b;
}

#endif
