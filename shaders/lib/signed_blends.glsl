// The operators of signed fields in [G] section 2. Mirrors server/operators/signed_blends.h by name.
#ifndef SIGNED_BLENDS_GLSL
#define SIGNED_BLENDS_GLSL

#include "dual.glsl"
#include "profiles.glsl"

// [G] eqs. 5 and 8; `a` holds a0, 1 / a1^2, 1 / a2^2.
Binary pasko_blend(Dual x1, Dual x2, vec3 a) {
  // Scaled, so that no square over- or underflows.
  float size = max(max(abs(value_of(x1)), abs(value_of(x2))), 1e-30);
  Dual u1 = x1 * (1.0 / size), u2 = x2 * (1.0 / size);
  Dual r = square_root(times(u1, u1) + times(u2, u2));
  bool is_corner = value_of(r) < 0.5;  // both 0
  Dual inverse = select_dual(reciprocal(select_dual(r, dual(1.0), is_corner)), dual(0.0), is_corner);
  Dual w = reciprocal(dual(1.0) + a.y * times(x1, x1) + a.z * times(x2, x2));
  Dual fall = 2.0 * a.x * times(w, w);
  return Binary(x1 + x2 - size * r + a.x * w, dual(1.0) - times(u1, inverse) - a.y * times(fall, x1),
                dual(1.0) - times(u2, inverse) - a.z * times(fall, x2));
}

struct Bracket {
  Dual value, fall;
};
// [1 - x/r]_+^t and minus its derivative.
Bracket superelliptic_bracket(Dual x, Dual range, float t) {
  Dual inverse = reciprocal(range);
  Dual u = dual(1.0) - times(x, inverse);
  bool is_out = value_of(u) <= 0.0;
  u = select_dual(u, dual(1.0), is_out);
  Bracket b = Bracket(power(u, t), t * times(power(u, t - 1.0), inverse));
  return Bracket(select_dual(b.value, dual(0.0), is_out), select_dual(b.fall, dual(0.0), is_out));
}

// [G] eq. 6: x2 - H(x1). `curve`: its table, the first control point, cells per unit.
Binary functional_blend(Dual x1, Dual x2, vec3 curve) {
  float x = value_of(x1) - curve.y;
  vec3 h = profile(floatBitsToUint(curve.x), CURVE_CELLS, x * curve.z) * vec3(1.0, curve.z, curve.z * curve.z);
  bool is_beyond = x <= 0.0 || x * curve.z >= float(CURVE_CELLS);
  h.yz = is_beyond ? vec2(0.0) : h.yz;
  return Binary(x2 - chain(x1, h.x, h.y), -chain(x1, h.y, h.z), dual(1.0));
}

#endif
