// Barthe's functional blend, [G] eq. 6. Mirrors server/operators/functional.h.
#ifndef FUNCTIONAL_GLSL
#define FUNCTIONAL_GLSL

#include "joining.glsl"
#include "parameters.glsl"
#include "steering.glsl"

// Returns the curve through control points at x, with its first and second derivatives. `curve` holds the place of its
// table, the number of its pieces (at most 255), and x and H of the last control point.
vec3 control_curve(vec4 curve, float x) {
  uint table = floatBitsToUint(curve.x), piece = 0u, above = floatBitsToUint(curve.y);
  for (int step = 0; step < 8; ++step) {
    uint middle = (piece + above) >> 1u;
    bool is_above = tables[table + 2u * middle].x > x;
    piece = is_above ? piece : middle;
    above = is_above ? middle : above;
  }
  vec2 begin = tables[table + 2u * piece].xy;
  vec4 c = tables[table + 2u * piece + 1u];
  float s = clamp((x - begin.x) * begin.y, 0.0, 1.0);
  vec3 h = vec3(c.x + s * (c.y + s * (c.z + s * c.w)), begin.y * (c.y + s * (2.0 * c.z + s * (3.0 * c.w))),
                begin.y * begin.y * (2.0 * c.z + 6.0 * s * c.w));
  // The curve is constant beyond both ends. Beyond the last control point it has exactly that point's value, so that
  // culling may rely on a 0 there.
  bool is_above = x >= curve.z, is_below = piece == 0u && x <= begin.x;
  return vec3(is_above ? curve.w : h.x, is_above || is_below ? vec2(0.0) : h.yz);
}

// Returns min(x1, x2) - H(|x1 - x2|).
Binary functional_blend(Dual x1, Dual x2, vec4 curve) {
  bool swap = value_of(x2) < value_of(x1);
  Dual least = select_dual(x1, x2, swap), apart = select_dual(x2, x1, swap) - least;
  vec3 h = control_curve(curve, value_of(apart));
  Dual slope = chain(apart, h.y, h.z);
  Binary r = Binary(least - chain(apart, h.x, h.y), dual(1.0) + slope, -slope);
  return select_binary(r, exchanged(r), swap);
}

Field unite_functional(Field a, Field b, uint record, Angle angle) {
  return join_signed(a, b, functional_blend(dual_of(a), dual_of(b), operation_at(record)));
}

#endif
