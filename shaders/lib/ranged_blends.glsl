// The operators of [H] on signed fields. Mirrors server/operators/ranged_blends.h by name.
#ifndef RANGED_BLENDS_GLSL
#define RANGED_BLENDS_GLSL

#include "dual.glsl"
#include "opcodes.glsl"

// Ranges and weights of two operands.
struct Reach2 {
  Dual r1, r2, m1, m2;
};

// [H] eq. 4 from the left end of its bracket. Where one operand alone makes the result it is x_i / m_i to the bit, as it
// is where culling has dropped the other.
Binary bt2(Dual x1, Dual x2, Reach2 reach, Dual p, vec2 inverse_weights) {
  Dual r1 = reach.r1, r2 = reach.r2, m1 = reach.m1, m2 = reach.m2;
  Dual spread = times(r1, m2) + times(r2, m1);
  Dual inverse_spread = reciprocal(spread);
  Dual lead = times(m2, x1) - times(m1, x2);
  Dual y1 = times(times(r1, lead + times(m1, r2)), inverse_spread);
  Dual y2 = times(times(r2, times(m2, r1) - lead), inverse_spread);
  bool first = value_of(y1) <= 0.0, second = value_of(y2) <= 0.0;
  y1 = select_dual(y1, dual(1.0), first);
  y2 = select_dual(y2, dual(1.0), second);
  Dual low = times(times(r1, x2) + times(r2, x1) - times(r1, r2), inverse_spread);
  Dual k = times(r1, r2) - p;
  Dual yy = times(y1, y2);
  Dual b = 2.0 * times(k, times(m1, y2) + times(m2, y1));
  Dual a = times(spread, spread) - 2.0 * times(k, times(m1, m2));
  Dual slope = square_root(times(b, b) + 8.0 * times(times(a, k), yy));
  Dual delta = 4.0 * over(times(k, yy), b + slope);
  Dual inverse = reciprocal(slope);
  Dual both = 2.0 * times(spread, delta);
  Binary r = Binary(low + delta, times(times(both, r2) + 2.0 * times(k, y2 - times(m2, delta)), inverse),
                    times(times(both, r1) + 2.0 * times(k, y1 - times(m1, delta)), inverse));
  // Weights that follow the gradients are divided by; constant ones have their inverse.
  Dual i1 = inverse_weights.x > 0.0 ? dual(inverse_weights.x) : reciprocal(m1);
  Dual i2 = inverse_weights.y > 0.0 ? dual(inverse_weights.y) : reciprocal(m2);
  r = select_binary(r, Binary(times(x2, i2), dual(0.0), i2), second);
  return select_binary(r, Binary(times(x1, i1), i1, dual(0.0)), first);
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
    float q = is_active ? exp2((terms[i].power - 1.0) * log2(value_of(t))) : 0.0;
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

Dual angular_range(float range, Dual cosine, float omega) { return range * (dual(1.0 + omega) - cosine); }

// [H] section 5. The ratio is kept within [1 / MOST_RATIO, MOST_RATIO].
const float MOST_RATIO = 8.0;
void eliminate_bulge(inout Reach2 reach, Dual cosine, Dual ratio, float omega) {
  reach.r1 = angular_range(value_of(reach.r1), cosine, omega);
  reach.r2 = angular_range(value_of(reach.r2), cosine, omega);
  Dual m1 = reach.m1, m2 = reach.m2;
  bool is_aligned = value_of(cosine) > 0.0;
  bool first_leads = value_of(m1) > value_of(m2) * value_of(ratio);
  reach.m2 = select_dual(m2, m2 + times(over(m1, ratio) - m2, cosine), is_aligned && first_leads);
  reach.m1 = select_dual(m1, m1 + times(times(m2, ratio) - m1, cosine), is_aligned && !first_leads);
}

#endif
