// Composition operators on fields. Mirrors server/reference/ by name; definitions in proto/isofield/v1/scene.proto.
#ifndef OPERATORS_GLSL
#define OPERATORS_GLSL

#include "angles.glsl"
#include "classic_blends.glsl"
#include "gradient_blend.glsl"
#include "ranged_blends.glsl"
#include "signed_blends.glsl"
#include "volume.glsl"
#ifdef CELL_SIZE
#include "seams.glsl"
#endif

Field sum(Field a, Field b) {
  a.f += b.f;
  a.d += b.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    a.g += b.g;
    a.j += b.j;
  }
#endif
  return a;
}

// One of the two.
Field sharp_union(Field a, Field b, bool take_b) {
  Field r = select_field(a, b, take_b);
#ifdef CELL_SIZE
  even_seam(r, a, b, take_b ? 1.0 : 0.0, SHARP_SEAM);
#endif
  return r;
}

// max(0, min(a, 1 - b)).
Field subtract(Field a, Field b) {
  b.f = 1.0 - b.f;
  b.d = -b.d;
#ifdef WITH_GRADIENT
  b.g = -b.g;
  b.j = -b.j;
#endif
  Field r = sharp_union(a, b, b.f < a.f);
  return select_field(r, zero_field(), r.f <= 0.0);
}

#ifdef WITH_GRADIENT
// Joins gradients and Jacobians of an operator g(f1, f2) steered by nothing: d_g = g1 d1 + g2 d2.
void join_derivatives(inout Field r, Field a, Field b, float g1, float g2, vec3 g1_v, vec3 g2_v) {
  r.j = g1 * a.j + g2 * b.j + outerProduct(a.d, g1_v) + outerProduct(b.d, g2_v);
}
#endif

Dual dual_of(Field a) {
#ifdef WITH_GRADIENT
  return vec4(a.f, a.g);
#else
  return a.f;
#endif
}

// An operator of two fields from its value and partials.
Field join_binary(Field a, Field b, Binary o) {
  Field r = zero_field();
  float g1 = value_of(o.g1), g2 = value_of(o.g2);
  r.f = value_of(o.g);
  r.d = g1 * a.d + g2 * b.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    r.g = gradient_of(o.g);
    join_derivatives(r, a, b, g1, g2, gradient_of(o.g1), gradient_of(o.g2));
  }
#endif
  return r;
}

// Signed fields end here and are constant beyond; steeper ones count as level. Folded or nested often enough, their
// operators would leave float32.
const float MOST_FIELD = 1e37;
Field bounded(Field a) {
  // Sums, in which nothing that is no number gets lost.
  vec3 size = abs(a.d);
#ifdef WITH_GRADIENT
  if (is_steered()) size += abs(a.g) + abs(a.j[0]) + abs(a.j[1]) + abs(a.j[2]);
#endif
  float slope = size.x + size.y + size.z;
  Field r = select_field(zero_field(), a, abs(a.f) < MOST_FIELD && slope < MOST_FIELD);
  r.f = clamp(a.f, -MOST_FIELD, MOST_FIELD);  // whatever the slope, so that kernels of values alone need none
  return r;
}

// A signed operator's.
Field join_signed(Field a, Field b, Binary o) { return bounded(join_binary(a, b, o)); }

// A positive operator's: a field of 0 leaves the other untouched, to the bit.
Field join_positive(Field a, Field b, Binary o) {
  Field r = select_field(join_binary(a, b, o), a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

// factor f + offset.
Field linear(Field a, float factor, float offset) {
  a.f = factor * a.f + offset;
  a.d *= factor;
#ifdef WITH_GRADIENT
  a.g *= factor;
  a.j *= factor;
#endif
  return a;
}

// w(clamp(R0 + slope f, 0, 1)) of a signed field.
Field softened(Field a, float slope) {
  float r = clamp(R0 + slope * a.f, 0.0, 1.0);
  float v = 1.0 - r * r;
  Field b = zero_field();
  b.f = v * v * v;
  float w1 = -6.0 * r * v * v * slope;
  b.d = w1 * a.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    float w2 = r > 0.0 ? -6.0 * v * (1.0 - 5.0 * r * r) * slope * slope : 0.0;
    b.g = w1 * a.g;
    b.j = w1 * a.j + w2 * outerProduct(a.d, a.g);
  }
#endif
  return b;
}

// What a form makes of its operands before the union of them, and of that after: modes of opcodes.glsl. Beside a positive
// complement, one that is negative is as good as 0.
Field complement(Field a, uint mode) {
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field c = linear(a, -1.0, is_signed ? 0.0 : 1.0);
  return select_field(c, zero_field(), !is_signed && c.f <= 0.0);
}

Field formed(Field r, Field first, Field second, uint mode) {
  uint form = mode & 3u;
  bool is_signed = (mode & MODE_SIGNED) != 0u;
  Field turned = complement(r, mode);
  if (!is_signed) {
    bool is_intersection = form == FORM_INTERSECTION;
    // 0 is outside: of an intersection, and of what is left of 0. What is less 0 is clamped alone.
    bool is_zero = turned.f <= 0.0 || first.f <= 0.0 || (is_intersection && second.f <= 0.0);
    bool is_first = !is_intersection && second.f <= 0.0 && first.f < 1.0;
    turned = select_field(turned, first, is_first);
    // The union of complements is the greatest of them where one is not positive.
    bool is_least = is_intersection && min(first.f, second.f) >= 1.0;
    turned = select_field(turned, select_field(first, second, second.f < first.f), is_least);
    turned = select_field(turned, zero_field(), is_zero);
  }
  return select_field(r, turned, form != FORM_UNION);
}

// An operand's direction in the frame of the operator at `record`, with lengths and angles as they are before the
// transforms above the operator: Affine::gradient_frame() of server/blobtree/geometry/affine.h. A record that has no frame before
// it is that of an operator that follows no angle, and the result does not count.
Field in_frame(Field a, uint record) {
  if (has_frames()) {
    uint at = max(record, 2u) - 2u;
    vec4 l = operation_at(at), rest = operation_at(at + 1u);
    mat3 to_frame = mat3(vec3(l.x, 0.0, 0.0), vec3(l.yz, 0.0), vec3(l.w, rest.xy));
    a.d = to_frame * a.d;
#ifdef WITH_GRADIENT
    a.j = to_frame * a.j;
#endif
  }
  return a;
}

// The angle between two fields' directions: its cosine, 0 where one vanishes, 1 less the cosine, which keeps its digits
// where directions are almost the same, and |first| / |second|.
struct Angle {
  Dual cosine, versine, ratio;
};
Angle angle_between(Field a, Field b) {
  // Directions that are too long to be squared are taken shorter.
  float longest1 = max(max(abs(a.d.x), abs(a.d.y)), abs(a.d.z)), longest2 = max(max(abs(b.d.x), abs(b.d.y)), abs(b.d.z));
  float scale1 = longest1 > 1e15 ? 1.0 / longest1 : 1.0, scale2 = longest2 > 1e15 ? 1.0 / longest2 : 1.0;
  a.d *= scale1;
  b.d *= scale2;
#ifdef WITH_GRADIENT
  a.j *= scale1;
  b.j *= scale2;
#endif
  float n1 = dot(a.d, a.d), n2 = dot(b.d, b.d);
  bool is_null = min(n1, n2) <= 1e-24;
#ifdef WITH_GRADIENT
  Dual d12 = vec4(dot(a.d, b.d), b.d * a.j + a.d * b.j);
  Dual d11 = vec4(is_null ? 1.0 : n1, 2.0 * (a.d * a.j)), d22 = vec4(is_null ? 1.0 : n2, 2.0 * (b.d * b.j));
#else
  Dual d12 = dot(a.d, b.d), d11 = is_null ? 1.0 : n1, d22 = is_null ? 1.0 : n2;
#endif
  Dual cosine = times(d12, reciprocal(times(square_root(d11), square_root(d22))));
  Dual ratio = (scale2 / scale1) * square_root(over(d11, d22));
  // Rounding may pass 1, where the cosine has no gradient.
  cosine = select_dual(cosine, dual(value_of(cosine) > 0.0 ? 1.0 : -1.0), abs(value_of(cosine)) >= 1.0);
  vec3 apart = a.d / sqrt(value_of(d11)) - b.d / sqrt(value_of(d22));
  Dual versine = chain(cosine, 0.5 * dot(apart, apart), -1.0);
  bool is_extreme = value_of(ratio) < 1.0 / MOST_RATIO || value_of(ratio) > MOST_RATIO;
  return Angle(select_dual(cosine, dual(0.0), is_null), select_dual(versine, dual(1.0), is_null),
               select_dual(ratio, dual(is_null ? 1.0 : clamp(value_of(ratio), 1.0 / MOST_RATIO, MOST_RATIO)), is_null || is_extreme));
}

Angle no_angle() { return Angle(dual(0.0), dual(1.0), dual(1.0)); }

// `angle` counts where the operator follows it.
Field blend_bt2(Field a, Field b, uint record, Angle angle) {
  vec4 head = operation_at(record), w1 = operation_at(record + 1u), w2 = operation_at(record + 2u);
  Reach2 reach = Reach2(dual(head.x), dual(head.y), dual(w1.z), dual(w2.z));
  vec2 inverse_weights = vec2(w1.x, w2.x);
  if (may_follow_angle() && head.w >= 0.0) {
    eliminate_bulge(reach, angle.cosine, angle.versine, angle.ratio, head.w);
    inverse_weights = vec2(0.0);
  }
  return join_signed(a, b, bt2(dual_of(a), dual_of(b), reach, head.z, inverse_weights));
}

// N-ary operators take the operands whose bits `mask` has, the last one first: x[0] belongs to the highest bit. What is
// beyond is of no operand.

// The place of the record of the operand at x[j], which takes its bit away.
uint take_operand(inout uint mask, uint record, out bool is_there) {
  is_there = mask != 0u;
  uint bit = is_there ? uint(findMSB(mask)) : 0u;
  mask &= ~(1u << bit);
  return record + 1u + bit;
}

// What a form makes of operands before their union.
void turn_operands(inout Field x[MAX_OPERANDS], uint mask, uint form) {
  for (uint j = 0u; j < ARITY; ++j) {
    bool is_there;
    uint bit = take_operand(mask, 0u, is_there) - 1u;
    if (form == FORM_INTERSECTION || bit == 0u) x[j] = linear(x[j], -1.0, 0.0);
  }
}

// The joint result from its partials, which are 0 where there is no operand.
Field join_operands(Field x[MAX_OPERANDS], Dual g, Dual partials[MAX_OPERANDS]) {
  Field r = zero_field();
  r.f = value_of(g);
#ifdef WITH_GRADIENT
  r.g = gradient_of(g);
#endif
  for (uint j = 0u; j < ARITY; ++j) {
    float w = value_of(partials[j]);
    r.d += w * x[j].d;
#ifdef WITH_GRADIENT
    if (is_steered()) r.j += w * x[j].j + outerProduct(x[j].d, gradient_of(partials[j]));
#endif
  }
  return bounded(r);
}

// [H] eq. 5.
Field blend_btk(Field x[MAX_OPERANDS], uint mask, uint record, Angle angle) {
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

// [G] eq. 4.
Field blend_superelliptic(Field x[MAX_OPERANDS], uint mask, uint record, Angle angle) {
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

// (a^t + b^t)^(1/t), with the larger field taken out so that no power under- or overflows.
Field ricci(Field a, Field b, vec2 exponent) {
  float t = exponent.x;
  float hi = max(a.f, b.f), lo = min(a.f, b.f);
  float ratio = hi > 0.0 ? lo / hi : 0.0;
  float power = ratio > 0.0 ? power_of(ratio, 0.0, t) : 0.0;
  float growth = power > 0.0 ? power_of(1.0 + power, 0.0, exponent.y) : 1.0;
  float g = hi * growth;
  // The partials (a/g)^(t - 1) and (b/g)^(t - 1): of the larger field growth^(1 - t).
  float w_hi = growth / (1.0 + power), w_lo = ratio > 0.0 ? w_hi * (power / ratio) : 0.0;
  float inverse = g > 0.0 ? 1.0 / g : 0.0;
  float x = a.f * inverse, y = b.f * inverse;
  // At t = 1 both are 1.
  float x1 = t == 1.0 ? 1.0 : a.f < b.f ? w_lo : w_hi, y1 = t == 1.0 ? 1.0 : a.f < b.f ? w_hi : w_lo;
  Field r = zero_field();
  r.f = g;
  r.d = x1 * a.d + y1 * b.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    r.g = x1 * a.g + y1 * b.g;
    float xx = x > 1e-6 ? x1 / x : 0.0, yy = y > 1e-6 ? y1 / y : 0.0;
    float g11 = (t - 1.0) * inverse * (xx - x1 * x1);
    float g12 = (t - 1.0) * inverse * (-x1 * y1);
    float g22 = (t - 1.0) * inverse * (yy - y1 * y1);
    join_derivatives(r, a, b, x1, y1, g11 * a.g + g12 * b.g, g12 * a.g + g22 * b.g);
  }
#endif
  r = select_field(r, a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

// Below this square of a gradient (times the operation's length) it counts as vanishing, [G] section 7.
const float NULL_GRADIENT = 1e-3;

// 1 where a gradient is there, 0 where it vanishes, with the derivative with respect to the squared norm.
vec2 gradient_presence(float n) {
  float s = clamp(n / NULL_GRADIENT, 0.0, 1.0);
  return vec2(s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / NULL_GRADIENT);
}

// [G] eqs. 15 to 24, steered by the angle between the operands' directions in the operator's frame, those of `u` and `v`;
// the gradient is the whole of eq. 29.
// `blend`: a silhouette for gradient_blend(), or with `is_volume` the slot of a volume and its size << 8; of a sampled
// operator the operation's length is negative.
Field blend_by_gradient(Field a, Field b, Field u, Field v, vec4 operation, uint blend, bool is_volume) {
  uint opening = floatBitsToUint(operation.x);
  float t_min = operation.z;
  float h = abs(operation.w);
  vec3 d1 = u.d * h, d2 = v.d * h;
  float n1 = dot(d1, d1), n2 = dot(d2, d2);
  // Unit vectors, but for directions that vanish: products of lengths would leave float32.
  float inverse1 = inversesqrt(max(n1, 1e-12)), inverse2 = inversesqrt(max(n2, 1e-12));
  vec3 u1 = inverse1 * d1, u2 = inverse2 * d2;
  vec2 open = opening_tangent(opening, angle_between(u1, u2));
  vec2 w1 = gradient_presence(n1), w2 = gradient_presence(n2);
  float t = t_min + (open.x - t_min) * w1.x * w2.x;
#ifdef WITH_GRADIENT
  // Gradient of t: through the angle, and through the presence of either gradient.
  mat2x3 angle_d = angle_partials(u1, u2);
  float t_angle = h * w1.x * w2.x * open.y, t_presence = 2.0 * h * (open.x - t_min);
  vec3 t_v = (t_angle * inverse1 * angle_d[0] + t_presence * w1.y * w2.x * d1) * u.j +
             (t_angle * inverse2 * angle_d[1] + t_presence * w1.x * w2.y * d2) * v.j;
  // Ranges that differ by 1e18 make it larger than float32, where it counts no more.
  t_v = clamp(t_v, -MOST_FIELD, MOST_FIELD);
#endif

  Blend g;
  if (!is_volume) g = gradient_blend(a.f, b.f, t, blend);
  if (has_operator(OPERATOR_GRADIENT_VOLUME)) {
    if (is_volume) g = volume_blend(a.f, b.f, t, blend & 0xffu, blend >> 8u, operation.w > 0.0);
  }
  Field r = zero_field();
  r.f = g.g;
  r.d = g.g1 * a.d + g.g2 * b.d;
#ifdef WITH_GRADIENT
  r.g = g.g1 * a.g + g.g2 * b.g + g.gt * t_v;
  join_derivatives(r, a, b, g.g1, g.g2, g.g11 * a.g + g.g12 * b.g + g.g1t * t_v,
                   g.g12 * a.g + g.g22 * b.g + g.g2t * t_v);
#endif
#ifdef CELL_SIZE
  // A steeper field turns the gradient further.
  float turn1 = g.g1 * inverse2, turn2 = g.g2 * inverse1;
  even_seam(r, a, b, turn2 / max(turn1 + turn2, 1e-30), t > SHARP_OPENING ? SHARP_SEAM : NARROW_SEAM);
#endif
  // A field of 0 bypasses the operator.
  r = select_field(r, a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

// The union of two fields by an operator that no opening steers, `op` of `record`. `angle` as for blend_bt2.
Field unite(Field a, Field b, uint op, uint record, Angle angle) {
  Field r = b;
  IF_OPERATOR(op, OPERATOR_SUM) r = sum(a, b);
  IF_OPERATOR(op, OPERATOR_MAX) r = sharp_union(a, b, b.f > a.f);
  IF_OPERATOR(op, OPERATOR_MIN) r = sharp_union(a, b, b.f < a.f);
  IF_OPERATOR(op, OPERATOR_SUBTRACT) r = subtract(a, b);
  IF_OPERATOR(op, OPERATOR_SUBTRACT_FROM) r = subtract(b, a);
  IF_OPERATOR(op, OPERATOR_RICCI) r = ricci(a, b, operation_at(record).xy);
  IF_OPERATOR(op, OPERATOR_CLEAN) r = join_positive(a, b, clean_union(dual_of(a), dual_of(b)));
  IF_OPERATOR(op, OPERATOR_BARTHE) {
    vec4 o = operation_at(record);
    r = join_positive(a, b, barthe_blend(dual_of(a), dual_of(b), o.x, o.y));
  }
  IF_OPERATOR(op, OPERATOR_BERNHARDT) {
    vec4 o = operation_at(record);
    r = join_positive(a, b, bernhardt_blend(dual_of(a), dual_of(b), o.x, o.y, o.z));
  }
  IF_OPERATOR(op, OPERATOR_PASKO) {
    r = join_signed(a, b, pasko_blend(dual_of(a), dual_of(b), operation_at(record).xyz));
  }
  IF_OPERATOR(op, OPERATOR_FUNCTIONAL) {
    r = join_signed(a, b, functional_blend(dual_of(a), dual_of(b), operation_at(record)));
  }
  IF_OPERATOR(op, OPERATOR_BT2) r = blend_bt2(a, b, record, angle);
  return r;
}

// Whether the operator's union is sharp on the surface alone, or becomes sharp where gradients are aligned.
bool makes_seams(uint op, uint record) {
  IF_OPERATOR(op, OPERATOR_CLEAN) return true;
  IF_OPERATOR(op, OPERATOR_PASKO) return operation_at(record).x == 0.0;
  IF_OPERATOR(op, OPERATOR_BT2) return may_follow_angle() && operation_at(record).w >= 0.0;
  return false;
}

#endif
