// BTk, the super-elliptic blend of many operands with individual ranges, [H] eq. 5. Mirrors server/operators/btk.h.
#ifndef BTK_GLSL
#define BTK_GLSL

#include "bulge_elimination.glsl"
#include "many.glsl"
#include "powers.glsl"

// One operand of a BTk: its field x, 1 / m, its range and its power. An absent operand has a range of 0.
struct Term {
  Dual x, inverse_weight, range;
  float power;
};

// Returns the root of [H] eq. 5, found by Newton's method from min x_i / m_i; from there the steps descend to the root
// and never pass it. `partials` receives the partial derivatives, as duals.
Dual btk(Term terms[MAX_OPERANDS], inout Dual partials[MAX_OPERANDS]) {
  float h = 1e30;
  uint least = 0u;
  for (uint i = 0u; i < ARITY; ++i) {
    float at = value_of(terms[i].range) > 0.0 ? value_of(terms[i].x) * value_of(terms[i].inverse_weight) : 1e30;
    least = at < h ? i : least;
    h = min(h, at);
  }
  float start = h;
  bool is_blend = false;
  for (int step = 0; step < 24; ++step) {
    float excess = -1.0, slope = 0.0;
    for (uint i = 0u; i < ARITY; ++i) {
      float r = value_of(terms[i].range);
      float inverse_r = r > 0.0 ? 1.0 / r : 0.0;
      float m = 1.0 / value_of(terms[i].inverse_weight);
      float t = r > 0.0 ? 1.0 + (m * h - value_of(terms[i].x)) * inverse_r : 0.0;
      bool is_active = t > 0.0 && !(i == least && step == 0);
      is_blend = is_blend || is_active;
      // The least operand's bracket is exactly 1 at the start; rounding may have given something else.
      t = i == least && step == 0 ? 1.0 : t;
      // The driver's powers are exact enough for these steps, because the last step, in duals, uses power_of().
      float q = t > 0.0 ? exp2((terms[i].power - 1.0) * log2(t)) : 0.0;
      excess += q * max(t, 0.0);
      slope += terms[i].power * q * m * inverse_r;
    }
    float next = h - excess / max(slope, 1e-30);
    if (!(next < h)) break;
    h = next;
  }
  // A step of Newton's method in duals gives the derivatives of the root.
  Dual excess = dual(-1.0);
  float slope = 0.0;
  for (uint i = 0u; i < ARITY; ++i) {
    bool is_there = value_of(terms[i].range) > 0.0;
    Dual inverse_r = reciprocal(select_dual(dual(1.0), terms[i].range, is_there));
    Dual m = reciprocal(terms[i].inverse_weight);
    Dual t = dual(1.0) + times(h * m - terms[i].x, inverse_r);
    bool is_active = is_there && value_of(t) > 0.0;
    float q = is_active ? power_of(value_of(t), 0.0, terms[i].power - 1.0) : 0.0;
    excess += chain(t, q * max(value_of(t), 0.0), terms[i].power * q);
    slope += terms[i].power * q * value_of(m) * value_of(inverse_r);
  }
  Dual root = dual(h) - excess * (1.0 / max(slope, 1e-30));
  // A further pass with the dual root gives the derivatives of the partials.
  Dual total = dual(0.0);
  for (uint i = 0u; i < ARITY; ++i) {
    bool is_there = value_of(terms[i].range) > 0.0;
    Dual inverse_r = reciprocal(select_dual(dual(1.0), terms[i].range, is_there));
    Dual m = reciprocal(terms[i].inverse_weight);
    Dual t = dual(1.0) + times(times(m, root) - terms[i].x, inverse_r);
    bool is_active = is_there && value_of(t) > 0.0;
    t = select_dual(dual(1.0), t, is_active);
    partials[i] = select_dual(dual(0.0), terms[i].power * times(power(t, terms[i].power - 1.0), inverse_r), is_active);
    total += times(partials[i], m);
  }
  Dual inverse = reciprocal(select_dual(dual(1.0), total, value_of(total) > 1e-30));
  Dual single = dual(0.0);
  for (uint i = 0u; i < ARITY; ++i) {
    bool is_least = i == least;
    single = select_dual(single, times(terms[i].x, terms[i].inverse_weight), is_least);
    partials[i] = select_dual(select_dual(dual(0.0), terms[i].inverse_weight, is_least), times(partials[i], inverse),
                              is_blend);
  }
  return select_dual(single, root, is_blend);
}

Field unite_btk(Field x[MAX_OPERANDS], uint mask, uint record, Angle angle) {
  vec4 head = operation_at(record);
  Term terms[MAX_OPERANDS];
  for (uint j = 0u; j < ARITY; ++j) {
    bool is_there;
    vec4 t = operation_at(take_operand(mask, record, is_there));
    terms[j] = Term(dual_of(x[j]), dual(t.x), dual(is_there ? t.w : 0.0), t.z);
  }
  if (may_follow_angle() && head.y >= 0.0) {
    Reach2 reach = Reach2(terms[0].range, terms[1].range, reciprocal(terms[0].inverse_weight),
                          reciprocal(terms[1].inverse_weight));
    eliminate_bulge(reach, angle.cosine, angle.versine, angle.ratio, head.y);
    terms[0] = Term(terms[0].x, reciprocal(reach.m1), reach.r1, terms[0].power);
    terms[1] = Term(terms[1].x, reciprocal(reach.m2), reach.r2, terms[1].power);
  }
  Dual partials[MAX_OPERANDS];
  Dual g = btk(terms, partials);
  return join_operands(x, g, partials);
}

#endif
