// Operators of one field: conversions between positive and signed fields, and the factor 1 / weight that stays where
// culling has left a blend with one operand.
#ifndef CONVERSIONS_GLSL
#define CONVERSIONS_GLSL

#include "field.glsl"
#include "parameters.glsl"

// Returns factor f + offset.
Field linear(Field a, float factor, float offset) {
  a.f = factor * a.f + offset;
  a.d *= factor;
#ifdef WITH_GRADIENT
  a.g *= factor;
  a.j *= factor;
#endif
  return a;
}

// Returns w(clamp(R0 + slope f, 0, 1)) for a signed field f, which makes it positive.
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

Field apply_linear(Field a, uint record) { return linear(a, operation_at(record).x, operation_at(record).y); }

Field apply_soften(Field a, uint record) { return softened(a, operation_at(record).x); }

#endif
