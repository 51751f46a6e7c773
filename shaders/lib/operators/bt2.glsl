// BT2, the conic blend of two operands with individual ranges, [H] eq. 4. Mirrors server/operators/bt2.h.
#ifndef BT2_GLSL
#define BT2_GLSL

#include "bulge_elimination.glsl"
#include "joining.glsl"
#include "parameters.glsl"

// Returns BT2 in the form that server/operators/bt2.h derives. If one operand alone makes the result, that is x_i /
// m_i, the same bits as where culling has dropped the other operand.
Binary bt2(Dual x1, Dual x2, Reach2 reach, float tightness, vec2 inverse_weights) {
  // Constant weights come with their inverse; weights that follow the gradients are inverted here.
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

// The operator uses `angle` only if its ranges follow the angle.
Field unite_bt2(Field a, Field b, uint record, Angle angle) {
  vec4 head = operation_at(record), w1 = operation_at(record + 1u), w2 = operation_at(record + 2u);
  Reach2 reach = Reach2(dual(head.x), dual(head.y), dual(w1.z), dual(w2.z));
  vec2 inverse_weights = vec2(w1.x, w2.x);
  if (may_follow_angle() && head.w >= 0.0) {
    eliminate_bulge(reach, angle.cosine, angle.versine, angle.ratio, head.w);
    inverse_weights = vec2(0.0);
  }
  return join_signed(a, b, bt2(dual_of(a), dual_of(b), reach, head.z, inverse_weights));
}

// Ranges that follow an angle almost vanish where the gradients are aligned, which leaves a seam there.
bool makes_seams_bt2(uint record) { return may_follow_angle() && operation_at(record).w >= 0.0; }

#endif
