// Makes the field of an operator's result from the operator's value and partial derivatives.
#ifndef JOINING_GLSL
#define JOINING_GLSL

#include "dual.glsl"
#include "field.glsl"

#ifdef WITH_GRADIENT
// Computes the Jacobian of the direction g1 d1 + g2 d2 of an operator g(f1, f2). g1_v and g2_v are the gradients of g1
// and g2.
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

// The field of an operator of two fields, from the operator's value and partial derivatives.
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

// The largest magnitude of a signed field, which is constant beyond it; a field with a steeper slope gets the slope 0.
// Otherwise signed operators that are folded or nested often enough would leave float32.
const float MOST_FIELD = 1e37;
Field bounded(Field a) {
  // The magnitudes are summed, because a sum keeps a NaN.
  vec3 size = abs(a.d);
#ifdef WITH_GRADIENT
  if (is_steered()) size += abs(a.g) + abs(a.j[0]) + abs(a.j[1]) + abs(a.j[2]);
#endif
  float slope = size.x + size.y + size.z;
  Field r = select_field(zero_field(), a, abs(a.f) < MOST_FIELD && slope < MOST_FIELD);
  r.f = clamp(a.f, -MOST_FIELD, MOST_FIELD);  // independent of the slope, so that kernels of values alone need none
  return r;
}

// The field of a signed operator.
Field join_signed(Field a, Field b, Binary o) { return bounded(join_binary(a, b, o)); }

// The field of a positive operator. Where one operand is 0, the result is the other operand, to the bit.
Field join_positive(Field a, Field b, Binary o) {
  Field r = select_field(join_binary(a, b, o), a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

#endif
