// The operators of signed fields in [G] section 2. Mirrors server/operators/signed_blends.h by name.
#ifndef SIGNED_BLENDS_GLSL
#define SIGNED_BLENDS_GLSL

#include "dual.glsl"
#include "profiles.glsl"

const float FAR = 1e8;  // times a1 or a2

// [G] eqs. 5 and 8; `a` holds a0, 1 / a1^2, 1 / a2^2.
Binary pasko_blend(Dual x1, Dual x2, vec3 a) {
  // Scaled, so that no square over- or underflows.
  float size = max(max(abs(value_of(x1)), abs(value_of(x2))), 1e-30);
  Dual u1 = x1 * (1.0 / size), u2 = x2 * (1.0 / size);
  Dual r = square_root(times(u1, u1) + times(u2, u2));
  bool is_corner = value_of(r) < 0.5;  // both 0
  Dual inverse = select_dual(reciprocal(select_dual(r, dual(1.0), is_corner)), dual(0.0), is_corner);
  // Far out nothing is left of the blend, and squares would overflow.
  float i1 = sqrt(a.y), i2 = sqrt(a.z);
  Dual t1 = i1 * x1, t2 = i2 * x2;
  t1 = select_dual(t1, dual(FAR), abs(value_of(t1)) > FAR);
  t2 = select_dual(t2, dual(FAR), abs(value_of(t2)) > FAR);
  Dual w = reciprocal(dual(1.0) + times(t1, t1) + times(t2, t2));
  Dual fall = 2.0 * a.x * times(w, w);
  return Binary(x1 + x2 - size * r + a.x * w, dual(1.0) - times(u1, inverse) - i1 * times(fall, t1),
                dual(1.0) - times(u2, inverse) - i2 * times(fall, t2));
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
  // Above 1e12 it goes on straight.
  float deepest = exp2(39.863137 / t), slope = t * 1e12 / deepest;
  bool is_deep = value_of(u) > deepest;
  Dual above = u - dual(deepest);
  u = select_dual(u, dual(1.0), is_deep);
  Bracket b = Bracket(select_dual(power(u, t), dual(1e12) + slope * above, is_deep),
                      times(select_dual(t * power(u, t - 1.0), dual(slope), is_deep), inverse));
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
