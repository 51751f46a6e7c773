// Evaluates an operator from its volume, a table of samples over (f1, f2, theta); volume_blend() can replace
// gradient_blend(). The volume is interpolated trilinearly in float32, because hardware filters have weights of only 8
// bits. Mirrors server/operators/volume.h.
#ifndef VOLUME_GLSL
#define VOLUME_GLSL

#include "angles.glsl"
#include "bindings.glsl"
#include "gradient_blend.glsl"

// A volume holds (g, dg/df1, dg/df2, dg/dtheta) at size^3 nodes over f1, f2 in [0, 1] and theta in [0, pi/4]; f1 varies
// fastest.
layout(std430, binding = BINDING_SCENE_FIRST_VOLUME) readonly buffer Volume0 { vec4 volume0[]; };
layout(std430, binding = BINDING_SCENE_FIRST_VOLUME + 1) readonly buffer Volume1 { vec4 volume1[]; };
layout(std430, binding = BINDING_SCENE_FIRST_VOLUME + 2) readonly buffer Volume2 { vec4 volume2[]; };
layout(std430, binding = BINDING_SCENE_FIRST_VOLUME + 3) readonly buffer Volume3 { vec4 volume3[]; };

#define IF_SLOT(candidate) \
  if ((VOLUME_SET >> (candidate) & 1u) != 0u) if (VOLUME_SET == 1u << (candidate) || slot == (candidate))
vec4 volume_node(uint slot, uint at) {
  vec4 v = vec4(0.0);
  IF_SLOT(0u) v = volume0[at];
  IF_SLOT(1u) v = volume1[at];
  IF_SLOT(2u) v = volume2[at];
  IF_SLOT(3u) v = volume3[at];
  return v;
}

// The interpolated node, with the slopes of the interpolation.
struct VolumeCell {
  vec4 v;
#ifdef WITH_GRADIENT
  vec4 v1, v2, v_theta;
#endif
};

VolumeCell volume_cell(float f1, float f2, float theta, uint slot, uint size) {
  float last = float(size - 1u);
  const float PER_THETA = 1.27323954473516;  // 4 / pi
  vec3 place = clamp(vec3(f1, f2, theta * PER_THETA), 0.0, 1.0) * last;
  uvec3 cell = min(uvec3(place), uvec3(size - 2u));
  vec3 s = place - vec3(cell);
  uint at = (cell.z * size + cell.y) * size + cell.x;
  uint up = at + size * size;
  vec4 n000 = volume_node(slot, at), n100 = volume_node(slot, at + 1u);
  vec4 n010 = volume_node(slot, at + size), n110 = volume_node(slot, at + size + 1u);
  vec4 n001 = volume_node(slot, up), n101 = volume_node(slot, up + 1u);
  vec4 n011 = volume_node(slot, up + size), n111 = volume_node(slot, up + size + 1u);
  // A cell on the diagonal f1 = f2, where maxima and bulges have a fold, is divided into two prisms and linear in each.
  bool is_diagonal = cell.x == cell.y, is_lower = s.x >= s.y;
  if (is_diagonal && is_lower) {
    n010 = n000 + n110 - n100;
    n011 = n001 + n111 - n101;
  }
  if (is_diagonal && !is_lower) {
    n100 = n000 + n110 - n010;
    n101 = n001 + n111 - n011;
  }
  vec4 x00 = n000 + s.x * (n100 - n000), x10 = n010 + s.x * (n110 - n010);
  vec4 x01 = n001 + s.x * (n101 - n001), x11 = n011 + s.x * (n111 - n011);
  vec4 y0 = x00 + s.y * (x10 - x00), y1 = x01 + s.y * (x11 - x01);
  VolumeCell r;
  r.v = y0 + s.z * (y1 - y0);
#ifdef WITH_GRADIENT
  vec4 d00 = n100 - n000, d10 = n110 - n010, d01 = n101 - n001, d11 = n111 - n011;
  vec4 d0 = d00 + s.y * (d10 - d00), d1 = d01 + s.y * (d11 - d01);
  r.v1 = (d0 + s.z * (d1 - d0)) * last;
  vec4 e0 = x10 - x00, e1 = x11 - x01;
  r.v2 = (e0 + s.z * (e1 - e0)) * last;
  r.v_theta = (y1 - y0) * (last * PER_THETA);
#endif
  return r;
}

// Returns g at t = tan(theta) within [0, 1], for f1 and f2 >= 0. The nodes end at 1. Beyond, the gradient blend is
// homogeneous about (t/2, t/2), and any other operator is continued homogeneously about the origin; `profile_like` is
// true for the gradient blend. Where one field is 0, the result is the other one, to the bit.
Blend volume_blend(float f1, float f2, float t, uint slot, uint size, bool profile_like) {
  float hi = max(f1, f2);
  float h = profile_like ? 0.5 * t : 0.0;
  float scale = max((hi - h) / (1.0 - h), 1.0);
  bool is_beyond = hi > 1.0;
  float p1 = is_beyond ? h + (f1 - h) / scale : f1, p2 = is_beyond ? h + (f2 - h) / scale : f2;
  VolumeCell c = volume_cell(p1, p2, arctangent(t), slot, size);
  vec4 v = c.v;
  Blend b;
  b.g = is_beyond ? h + scale * (v.x - h) : v.x;
  b.g1 = v.y;
  b.g2 = v.z;
  // If the operator is continued about the origin, the partial along the larger field is that of scale * g(p).
  bool turns = is_beyond && !profile_like;
  bool exchanged = f1 < f2;
  if (turns && !exchanged) b.g1 = v.x - p2 * v.z;
  if (turns && exchanged) b.g2 = v.x - p1 * v.y;
#ifdef WITH_GRADIENT
  float theta_t = 1.0 / (1.0 + t * t);
  float gt = v.w * theta_t;
  vec2 g_t = vec2(c.v_theta.y, c.v_theta.z) * theta_t;  // the derivatives of g1 and g2 by t
  float g11 = c.v1.y, g12 = 0.5 * (c.v1.z + c.v2.y), g22 = c.v2.z;
  // The derivatives of the scale, of h and of p by t.
  float scale_t = profile_like ? 0.5 * (scale - 1.0) / (1.0 - h) : 0.0;
  float h_t = profile_like ? 0.5 : 0.0;
  vec2 p_t = is_beyond ? h_t * (1.0 - 1.0 / scale) - (vec2(p1, p2) - h) * (scale_t / scale) : vec2(0.0);
  b.gt = is_beyond ? h_t + scale_t * (v.x - h) + scale * (v.y * p_t.x + v.z * p_t.y + gt - h_t) : gt;
  b.g11 = g11 / scale;
  b.g12 = g12 / scale;
  b.g22 = g22 / scale;
  b.g1t = g_t.x + g11 * p_t.x + g12 * p_t.y;
  b.g2t = g_t.y + g12 * p_t.x + g22 * p_t.y;
  if (turns) {
    // The operator is m G(lo / m), with m the larger field, so all second partials follow from the one along the
    // smaller.
    float p = exchanged ? p1 : p2, g_lo_lo = (exchanged ? g11 : g22) / scale;
    float g_lo_t = exchanged ? g_t.x : g_t.y, g_hi_t = gt - p * g_lo_t;
    b.g11 = exchanged ? g_lo_lo : p * p * g_lo_lo;
    b.g12 = -p * g_lo_lo;
    b.g22 = exchanged ? p * p * g_lo_lo : g_lo_lo;
    b.g1t = exchanged ? g_lo_t : g_hi_t;
    b.g2t = exchanged ? g_hi_t : g_lo_t;
  }
#endif
  if (min(f1, f2) <= 0.0) {
    b.g = hi;
    b.g1 = exchanged ? 0.0 : 1.0;
    b.g2 = exchanged ? 1.0 : 0.0;
#ifdef WITH_GRADIENT
    b.gt = b.g11 = b.g12 = b.g22 = b.g1t = b.g2t = 0.0;
#endif
  }
  return b;
}

#endif
