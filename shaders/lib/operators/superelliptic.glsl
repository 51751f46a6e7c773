// The super-elliptic blend: server/operators/superelliptic.h.
#ifndef SUPERELLIPTIC_GLSL
#define SUPERELLIPTIC_GLSL

#include "bulge_elimination.glsl"
#include "many.glsl"
#include "powers.glsl"

struct Bracket {
  Dual value, fall;
};
// Returns what the rounded quotient q of x and r lacks of the exact one, since an exponent t multiplies q's relative
// error. It comes from the exact product of q and r, by their leading bits.
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

// [G] eq. 4.
Field unite_superelliptic(Field x[MAX_OPERANDS], uint mask, uint record, Angle angle) {
  vec4 head = operation_at(record);
  bool by_angle = may_follow_angle() && head.y >= 0.0;
  Dual g = dual(1.0);
  Dual partials[MAX_OPERANDS];
  for (uint j = 0u; j < ARITY; ++j) {
    bool is_there;
    float range = operation_at(take_operand(mask, record, is_there)).w;
    Dual r = dual(range);
    if (by_angle) r = angular_range(range, angle.versine, head.y);
    Bracket b = superelliptic_bracket(dual_of(x[j]), r, head.x, head.zw);
    g = g - select_dual(dual(0.0), b.value, is_there);
    partials[j] = select_dual(dual(0.0), b.fall, is_there);
  }
  return join_operands(x, g, partials);
}

#endif
