// The gradient-based blend, and operators given by samples. Mirrors server/operators/{gradient,sampled}.h.
#ifndef GRADIENT_GLSL
#define GRADIENT_GLSL

#include "angles.glsl"
#include "gradient_blend.glsl"
#include "joining.glsl"
#include "volume.glsl"

#ifdef CELL_SIZE
#include "seams.glsl"
#endif

// The squared norm of a gradient (times the operation's length) below which the gradient gradually counts as vanishing,
// [G] section 7.
const float NULL_GRADIENT = 1e-3;

// Returns 1 where a gradient is large enough, falling smoothly to 0 where it vanishes, and the derivative of that
// number with respect to the squared norm n.
vec2 gradient_presence(float n) {
  float s = clamp(n / NULL_GRADIENT, 0.0, 1.0);
  return vec2(s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / NULL_GRADIENT);
}

// Returns the blend of [G] eqs. 15 to 24, steered by the angle between the directions of u and v, which are the
// operands in the operator's frame. The gradient has all terms of eq. 29. `operation` is the operator's record. `blend`
// is a silhouette for gradient_blend() or, if `is_volume`, the slot of a volume and its size << 8. A sampled operator
// has a negative length in its record.
Field blend_by_gradient(Field a, Field b, Field u, Field v, vec4 operation, uint blend, bool is_volume) {
  uint opening = floatBitsToUint(operation.x);
  float t_min = operation.z;
  float h = abs(operation.w);
  vec3 d1 = u.d * h, d2 = v.d * h;
  float n1 = dot(d1, d1), n2 = dot(d2, d2);
  // u1 and u2 are unit vectors, unless a direction vanishes; products of unscaled lengths would leave float32.
  float inverse1 = inversesqrt(max(n1, 1e-12)), inverse2 = inversesqrt(max(n2, 1e-12));
  vec3 u1 = inverse1 * d1, u2 = inverse2 * d2;
  vec2 open = opening_tangent(opening, angle_between(u1, u2));
  vec2 w1 = gradient_presence(n1), w2 = gradient_presence(n2);
  float t = t_min + (open.x - t_min) * w1.x * w2.x;
#ifdef WITH_GRADIENT
  // The gradient of t has parts through the angle and through the presence of either gradient.
  mat2x3 angle_d = angle_partials(u1, u2);
  float t_angle = h * w1.x * w2.x * open.y, t_presence = 2.0 * h * (open.x - t_min);
  vec3 t_v = (t_angle * inverse1 * angle_d[0] + t_presence * w1.y * w2.x * d1) * u.j +
             (t_angle * inverse2 * angle_d[1] + t_presence * w1.x * w2.y * d2) * v.j;
  // Ranges that differ by a factor of 1e18 would make it larger than float32 holds; there it has no effect any more.
  t_v = clamp(t_v, -MOST_FIELD, MOST_FIELD);
#endif

  Blend g;
  if (!is_volume) g = gradient_blend(a.f, b.f, t, blend);
  if (HAS_OPERATOR_GRADIENT_VOLUME) {
    if (is_volume) g = volume_blend(a.f, b.f, t, blend & 0xffu, blend >> 8u, operation.w > 0.0);
  }
  Field r = zero_field();
  r.f = g.g;
  r.d = g.g1 * a.d + g.g2 * b.d;
#ifdef WITH_GRADIENT
  r.g = g.g1 * a.g + g.g2 * b.g + g.gt * t_v;
  join_derivatives(r, a, b, g.g1, g.g2, g.g11 * a.g + g.g12 * b.g + g.g1t * t_v,
                   g.g12 * a.g + g.g22 * b.g + g.g2t * t_v);
#endif
#ifdef CELL_SIZE
  // The steeper a field is, the more it turns the gradient: its part is its partial times its slope.
  float turn1 = g.g1 * inverse2, turn2 = g.g2 * inverse1;
  even_seam(r, a, b, turn2 / max(turn1 + turn2, 1e-30), t > SHARP_OPENING ? SHARP_SEAM : NARROW_SEAM);
#endif
  // If one field is 0, the result is the other one.
  r = select_field(r, a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

Field unite_gradient(Field a, Field b, Field u, Field v, uint record) {
  return blend_by_gradient(a, b, u, v, operation_at(record), SMOOTH_SILHOUETTE, false);
}

Field unite_gradient_table(Field a, Field b, Field u, Field v, uint record) {
  uint silhouette = silhouette_half(floatBitsToUint(operation_at(record).y), a.f, b.f);
  return blend_by_gradient(a, b, u, v, operation_at(record), silhouette, false);
}

Field unite_gradient_volume(Field a, Field b, Field u, Field v, uint record) {
  return blend_by_gradient(a, b, u, v, operation_at(record), floatBitsToUint(operation_at(record).y), true);
}

#endif
