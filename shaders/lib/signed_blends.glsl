// The operators of signed fields in [G] section 2. Mirrors server/operators/signed_blends.h by name.
#ifndef SIGNED_BLENDS_GLSL
#define SIGNED_BLENDS_GLSL

#include "dual.glsl"
#include "profiles.glsl"

const float FAR = 1e8;  // times a1 or a2

// [G] eqs. 5 and 8; `a` holds a0, 1 / a1^2, 1 / a2^2.
Binary pasko_blend(Dual x1, Dual x2, vec3 a) {
  // Scaled, so that no square over- or underflows; fields are at most MOST_FIELD.
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
// Returns what the rounded quotient q of x and r lacks of the exact one, since an exponent t multiplies q's relative error.
// It comes from the exact product of q and r, by their leading bits.
float missing_of_quotient(float q, float x, float r, float inverse_r) {
  precise float q1 = leading(q), q2 = q - q1, r1 = leading(r), r2 = r - r1;
  precise float rest = ((x - q1 * r1) - q1 * r2) - q2 * r;
  return rest * inverse_r;
}

// [1 - x/r]_+^t and minus its derivative. Above u = 1 - x/r = deepest, where the power is 1e12, it goes on straight;
// `deepest` has that and, as a part of it, what it lacks.
Bracket superelliptic_bracket(Dual x, Dual range, float t, vec2 deepest) {
  Dual inverse = reciprocal(range);
  Dual q = times(x, inverse), u = dual(1.0) - q;
  bool is_out = value_of(u) <= 0.0;
  u = select_dual(u, dual(1.0), is_out);
  bool is_deep = value_of(u) > deepest.x;
  float within = is_deep ? deepest.x : value_of(u);
  precise float missing = (1.0 - value_of(u)) - value_of(q);
  missing -= missing_of_quotient(value_of(q), value_of(x), value_of(range), value_of(inverse));
  missing = value_of(u) < 1e30 ? missing : 0.0;  // q may be infinite
  float tail = is_out ? 0.0 : is_deep ? deepest.y : missing / within;
  precise float above = is_deep ? (value_of(u) - within) + (missing - within * tail) : 0.0;
  float p = power_of(within, tail, t - 1.0);
  Bracket b = Bracket(chain(u, p * (within + (within * tail + t * above)), t * p),
                      times(chain(u, t * p, is_deep ? 0.0 : t * (t - 1.0) * p / within), inverse));
  return Bracket(select_dual(b.value, dual(0.0), is_out), select_dual(b.fall, dual(0.0), is_out));
}

// The curve through control points at x, with its first and second derivative. `curve`: its table, how many pieces it
// has (at most 255), the last control point.
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
  // Constant beyond both ends; exactly what the last control point says, so that culling may rely on a 0 there.
  bool is_above = x >= curve.z, is_below = piece == 0u && x <= begin.x;
  return vec3(is_above ? curve.w : h.x, is_above || is_below ? vec2(0.0) : h.yz);
}

// [G] eq. 6: min(x1, x2) - H(|x1 - x2|).
Binary functional_blend(Dual x1, Dual x2, vec4 curve) {
  bool swap = value_of(x2) < value_of(x1);
  Dual least = select_dual(x1, x2, swap), apart = select_dual(x2, x1, swap) - least;
  vec3 h = control_curve(curve, value_of(apart));
  Dual slope = chain(apart, h.y, h.z);
  Binary r = Binary(least - chain(apart, h.x, h.y), dual(1.0) + slope, -slope);
  return select_binary(r, exchanged(r), swap);
}

#endif
