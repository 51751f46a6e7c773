// The gradient-based composition operator. Mirrors server/operators/gradient_blend.h by name, in t = tan(theta):
// [G] eqs. 17 to 24 solved by Newton's method on the homogeneous smooth maximum.
#ifndef GRADIENT_BLEND_GLSL
#define GRADIENT_BLEND_GLSL

#include "field.glsl"
#include "profiles.glsl"

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

// g with partials with respect to f1, f2 and t.
struct Blend {
  float g, g1, g2;
#ifdef WITH_GRADIENT
  float gt, g11, g12, g22, g1t, g2t;
#endif
};

// `silhouette`: where its table starts, or SMOOTH_SILHOUETTE.
Blend gradient_blend(float f1, float f2, float t, uint silhouette) {
  float hi = max(f1, f2), lo = min(f1, f2);
  // Where lo <= k the profile is at u = 0, M = hi - k exactly and C stays hi: the maximum, to the bit.
  float c = hi;
  vec3 grading = silhouette_grading(silhouette);
  Boundary k;
  vec3 q;
  float a, u, rest, slope;
  // t is never negative: the count is 3, but the compiler cannot know and leaves a loop, which ends where all of a
  // subgroup's lanes have broken off: after one pass where the operator is the maximum, or where F is linear, as it is for
  // C >= 1/2; mostly after two elsewhere. Meshes of gradient blends take 0.7 to 0.8 of the time of three passes. The
  // profile of a table may bend without bound beside a fold: there partials are right only when C is.
  int steps = t >= 0.0 ? 3 : 1;
  float near = silhouette == SMOOTH_SILHOUETTE ? 1e-6 : 0.0;
  for (int step = 0; step < steps; ++step) {
    k = boundary(c, t);
    a = max(hi - k.k, 1e-30);
    // 1 - u has no cancellation where a table needs it; either way u is 0 exactly where lo <= k.
    float w = min((hi - lo) / a, 1.0);
    u = silhouette == SMOOTH_SILHOUETTE ? clamp((lo - k.k) / a, 0.0, 1.0) : 1.0 - w;
    q = silhouette_profile(silhouette, grading, u, w);
    rest = 1.0 - (q.x + (1.0 - u) * q.y);
    slope = 1.0 - k.k_f * rest;
    // F(C) = C - k - M: the last pass has the partials at the root, to 3 times `near`, and mends C once more.
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
  // Total derivatives of (g_hi, g_lo) along hi, lo and t: the implicit function theorem.
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
