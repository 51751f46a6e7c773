// The operators of [H] on signed fields. Mirrors server/operators/ranged_blends.h by name.
#ifndef RANGED_BLENDS_GLSL
#define RANGED_BLENDS_GLSL

#include "dual.glsl"
#include "opcodes.glsl"

// Ranges and weights of two operands.
struct Reach2 {
  Dual r1, r2, m1, m2;
};

// [H] eq. 4 as server/operators/ranged_blends.h has it. Where one operand alone makes the result it is x_i / m_i to the
// bit, as it is where culling has dropped the other.
Binary bt2(Dual x1, Dual x2, Reach2 reach, float tightness, vec2 inverse_weights) {
  // Weights that follow the gradients are divided by; constant ones have their inverse.
  Dual i1 = inverse_weights.x > 0.0 ? dual(inverse_weights.x) : reciprocal(reach.m1);
  Dual i2 = inverse_weights.y > 0.0 ? dual(inverse_weights.y) : reciprocal(reach.m2);
  x1 = times(x1, i1);
  x2 = times(x2, i2);
  Dual r1 = times(reach.r1, i1), r2 = times(reach.r2, i2);
  Dual per_length = reciprocal(r1 + r2);
  Dual share1 = times(r1, per_length), share2 = times(r2, per_length);
  Dual apart = times(x1 - x2, per_length);
  Dual s1 = share2 + apart, s2 = share1 - apart;
  bool first = value_of(s1) <= 0.0, second = value_of(s2) <= 0.0;
  apart = select_dual(apart, dual(0.0), first || second);
  s1 = select_dual(s1, dual(0.5), first || second);
  s2 = select_dual(s2, dual(0.5), first || second);
  Dual per_whole = reciprocal(times(share2, s2) + times(share1, s1));
  Dual part1 = times(s1, per_whole), part2 = times(s2, per_whole), off = -times(apart, per_whole);
  float bend = 2.0 / tightness;
  Dual product = bend * times(part1, part2);
  Dual rho = square_root(times(off, off) + product);
  bool is_below = value_of(off) < 0.0;
  Dual greater = rho + select_dual(off, -off, is_below), lesser = over(product, greater);
  Dual above = select_dual(greater, lesser, is_below), below = select_dual(lesser, greater, is_below);
  Dual per_root = reciprocal(dual(1.0) + rho), scale = over(per_root, rho);
  Dual g1 = x1 - times(times(r1, s1), times(below, per_root)), g2 = x2 - times(times(r2, s2), times(above, per_root));
  Binary r = Binary(select_dual(g2, g1, value_of(apart) < 0.0),
                    times(times(times(share2, part2), bend * part1 + above), times(scale, i1)),
                    times(times(times(share1, part1), bend * part2 + below), times(scale, i2)));
  r = select_binary(r, Binary(x2, dual(0.0), i2), second);
  return select_binary(r, Binary(x1, i1, dual(0.0)), first);
}

// One operand of a btk: its field, 1 / m, the power and the range. One that is absent has a range of 0.
struct Term {
  Dual x, inverse_weight, range;
  float power;
};

const int MAX_OPERANDS = 16;

// [H] eq. 5 by Newton's method from min x_i / m_i, from where it falls to the root and never beyond it. `partials` come
// out with their derivatives.
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
      // The least operand's bracket is 1 at the start, whatever the rounding says.
      t = i == least && step == 0 ? 1.0 : t;
      // The driver's powers are exact enough for a step; the last step is the one in duals.
      float q = t > 0.0 ? exp2((terms[i].power - 1.0) * log2(t)) : 0.0;
      excess += q * max(t, 0.0);
      slope += terms[i].power * q * m * inverse_r;
    }
    float next = h - excess / max(slope, 1e-30);
    if (!(next < h)) break;
    h = next;
  }
  // A Newton step in duals gives the root its derivatives, ...
  Dual excess = dual(-1.0);
  float slope = 0.0;
  for (uint i = 0u; i < ARITY; ++i) {
    bool is_there = value_of(terms[i].range) > 0.0;
    Dual inverse_r = reciprocal(select_dual(dual(1.0), terms[i].range, is_there)), m = reciprocal(terms[i].inverse_weight);
    Dual t = dual(1.0) + times(h * m - terms[i].x, inverse_r);
    bool is_active = is_there && value_of(t) > 0.0;
    float q = is_active ? power_of(value_of(t), 0.0, terms[i].power - 1.0) : 0.0;
    excess += chain(t, q * max(value_of(t), 0.0), terms[i].power * q);
    slope += terms[i].power * q * value_of(m) * value_of(inverse_r);
  }
  Dual root = dual(h) - excess * (1.0 / max(slope, 1e-30));
  // ... and a pass with these the partials theirs.
  Dual total = dual(0.0);
  for (uint i = 0u; i < ARITY; ++i) {
    bool is_there = value_of(terms[i].range) > 0.0;
    Dual inverse_r = reciprocal(select_dual(dual(1.0), terms[i].range, is_there)), m = reciprocal(terms[i].inverse_weight);
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

// `versine` is 1 less the cosine.
Dual angular_range(float range, Dual versine, float omega) { return range * (dual(omega) + versine); }

// [H] section 5. The ratio is kept within [1 / MOST_RATIO, MOST_RATIO].
const float MOST_RATIO = 8.0;
void eliminate_bulge(inout Reach2 reach, Dual cosine, Dual versine, Dual ratio, float omega) {
  reach.r1 = angular_range(value_of(reach.r1), versine, omega);
  reach.r2 = angular_range(value_of(reach.r2), versine, omega);
  Dual m1 = reach.m1, m2 = reach.m2;
  bool is_aligned = value_of(cosine) > 0.0;
  bool first_leads = value_of(m1) > value_of(m2) * value_of(ratio);
  reach.m2 = select_dual(m2, m2 + times(over(m1, ratio) - m2, cosine), is_aligned && first_leads);
  reach.m1 = select_dual(m1, m1 + times(times(m2, ratio) - m1, cosine), is_aligned && !first_leads);
}

#endif
