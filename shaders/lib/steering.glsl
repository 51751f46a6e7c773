// Computes the angle between two fields' directions, in the frame of the operator that follows it.
#ifndef STEERING_GLSL
#define STEERING_GLSL

#include "dual.glsl"
#include "field.glsl"
#include "parameters.glsl"

// The ratio of two gradients' lengths is clamped to this factor: kMostRatio of server/operators/bulge_elimination.h.
const float MOST_RATIO = 8.0;

// Returns a field with its direction in the frame of the operator at `record`, with lengths and angles as they are
// before the transforms above the operator: Affine::gradient_frame() of server/blobtree/geometry/affine.h. If the
// operator follows no angle, its record may have no frame before it, and the result is not used.
Field in_frame(Field a, uint record) {
  if (has_frames()) {
    uint at = max(record, 2u) - 2u;
    vec4 l = operation_at(at), rest = operation_at(at + 1u);
    mat3 to_frame = mat3(vec3(l.x, 0.0, 0.0), vec3(l.yz, 0.0), vec3(l.w, rest.xy));
    a.d = to_frame * a.d;
#ifdef WITH_GRADIENT
    a.j = to_frame * a.j;
#endif
  }
  return a;
}

// The angle between two fields' directions. `cosine` is 0 where one of them vanishes; `versine` is 1 - cosine, computed
// so that it keeps its digits where the directions are almost the same; `ratio` is |first| / |second|.
struct Angle {
  Dual cosine, versine, ratio;
};
Angle angle_between(Field a, Field b) {
  // Directions that are too long to be squared are scaled down.
  float longest1 = max(max(abs(a.d.x), abs(a.d.y)), abs(a.d.z));
  float longest2 = max(max(abs(b.d.x), abs(b.d.y)), abs(b.d.z));
  float scale1 = longest1 > 1e15 ? 1.0 / longest1 : 1.0, scale2 = longest2 > 1e15 ? 1.0 / longest2 : 1.0;
  a.d *= scale1;
  b.d *= scale2;
#ifdef WITH_GRADIENT
  a.j *= scale1;
  b.j *= scale2;
#endif
  float n1 = dot(a.d, a.d), n2 = dot(b.d, b.d);
  bool is_null = min(n1, n2) <= 1e-24;
#ifdef WITH_GRADIENT
  Dual d12 = vec4(dot(a.d, b.d), b.d * a.j + a.d * b.j);
  Dual d11 = vec4(is_null ? 1.0 : n1, 2.0 * (a.d * a.j)), d22 = vec4(is_null ? 1.0 : n2, 2.0 * (b.d * b.j));
#else
  Dual d12 = dot(a.d, b.d), d11 = is_null ? 1.0 : n1, d22 = is_null ? 1.0 : n2;
#endif
  Dual cosine = times(d12, reciprocal(times(square_root(d11), square_root(d22))));
  Dual ratio = (scale2 / scale1) * square_root(over(d11, d22));
  // Rounding may make the cosine exceed 1. There it is set to 1, without a gradient.
  cosine = select_dual(cosine, dual(value_of(cosine) > 0.0 ? 1.0 : -1.0), abs(value_of(cosine)) >= 1.0);
  vec3 apart = a.d / sqrt(value_of(d11)) - b.d / sqrt(value_of(d22));
  Dual versine = chain(cosine, 0.5 * dot(apart, apart), -1.0);
  bool is_extreme = value_of(ratio) < 1.0 / MOST_RATIO || value_of(ratio) > MOST_RATIO;
  return Angle(select_dual(cosine, dual(0.0), is_null), select_dual(versine, dual(1.0), is_null),
               select_dual(ratio, dual(is_null ? 1.0 : clamp(value_of(ratio), 1.0 / MOST_RATIO, MOST_RATIO)),
                           is_null || is_extreme));
}

Angle no_angle() { return Angle(dual(0.0), dual(1.0), dual(1.0)); }

#endif
