// Ricci's blend, [G] eq. 11. Mirrors server/operators/ricci.h.
#ifndef RICCI_GLSL
#define RICCI_GLSL

#include "joining.glsl"
#include "powers.glsl"
#include "steering.glsl"

// Returns (a^t + b^t)^(1/t). `exponent` holds t and 1/t. The larger field is factored out, so that no power overflows
// or underflows.
Field ricci(Field a, Field b, vec2 exponent) {
  float t = exponent.x;
  float hi = max(a.f, b.f), lo = min(a.f, b.f);
  float ratio = hi > 0.0 ? lo / hi : 0.0;
  float power = ratio > 0.0 ? power_of(ratio, 0.0, t) : 0.0;
  float growth = power > 0.0 ? power_of(1.0 + power, 0.0, exponent.y) : 1.0;
  float g = hi * growth;
  // The partials are (a/g)^(t - 1) and (b/g)^(t - 1); for the larger field that is growth^(1 - t).
  float w_hi = growth / (1.0 + power), w_lo = ratio > 0.0 ? w_hi * (power / ratio) : 0.0;
  float inverse = g > 0.0 ? 1.0 / g : 0.0;
  float x = a.f * inverse, y = b.f * inverse;
  // Both are exactly 1 for t = 1, the sum.
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

Field unite_ricci(Field a, Field b, uint record, Angle angle) { return ricci(a, b, operation_at(record).xy); }

#endif
