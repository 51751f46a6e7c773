// The super-elliptic blend, [G] eq. 4. Mirrors server/operators/superelliptic.h.
#ifndef SUPERELLIPTIC_GLSL
#define SUPERELLIPTIC_GLSL

#include "bulge_elimination.glsl"
#include "many.glsl"
#include "powers.glsl"

// The term [1 - x/r]_+^t of one operand, and minus its derivative by x.
struct Bracket {
  Dual value, fall;
};
// Returns the exact quotient x / r minus its rounded value q; the exponent t multiplies the relative error of q, so it
// has to be corrected. The remainder comes from the exact product of q and r, computed in parts of 12 bits.
float missing_of_quotient(float q, float x, float r, float inverse_r) {
  precise float q1 = leading(q), q2 = q - q1, r1 = leading(r), r2 = r - r1;
  precise float rest = ((x - q1 * r1) - q1 * r2) - q2 * r;
  return rest * inverse_r;
}

// Returns the term of one operand. Above u = 1 - x/r = deepest, where the power is 1e12, it continues linearly.
// `deepest` holds that limit as a float and the relative error of this float.
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
