// Dual numbers: a number with its derivatives with respect to the three coordinates of a point. In kernels that compute
// no gradients (without WITH_GRADIENT) a Dual is a plain number. Mirrors server/reference/dual.h by name. Sums,
// differences and products with a plain number are those of vectors.
#ifndef DUAL_GLSL
#define DUAL_GLSL

#include "powers.glsl"

#ifdef WITH_GRADIENT
#define Dual vec4
Dual dual(float v) { return vec4(v, 0.0, 0.0, 0.0); }
float value_of(Dual a) { return a.x; }
vec3 gradient_of(Dual a) { return a.yzw; }
// Returns f(a) for a function f with this value and slope at a.
Dual chain(Dual a, float value, float slope) { return vec4(value, a.yzw * slope); }
Dual times(Dual a, Dual b) { return vec4(a.x * b.x, a.yzw * b.x + b.yzw * a.x); }
#else
#define Dual float
Dual dual(float v) { return v; }
float value_of(Dual a) { return a; }
Dual chain(Dual a, float value, float slope) { return value; }
Dual times(Dual a, Dual b) { return a * b; }
#endif

Dual reciprocal(Dual a) {
  float i = 1.0 / value_of(a);
  return chain(a, i, -i * i);
}
Dual over(Dual a, Dual b) { return times(a, reciprocal(b)); }
// The derivative is taken as 0 at 0, where it does not exist.
Dual square_root(Dual a) {
  float root = sqrt(max(value_of(a), 0.0));
  return chain(a, root, root > 0.0 ? 0.5 / root : 0.0);
}
// Returns a^exponent for a >= 0, and 0 for a = 0.
Dual power(Dual a, float exponent) {
  float x = value_of(a);
  float p = x > 0.0 ? power_of(x, 0.0, exponent - 1.0) : 0.0;
  return chain(a, p * x, exponent * p);
}
Dual select_dual(Dual a, Dual b, bool take_b) {
#ifdef WITH_GRADIENT
  return mix(a, b, bvec4(take_b));
#else
  return take_b ? b : a;
#endif
}

// The value g of an operator of two operands, with its partial derivatives g1 and g2.
struct Binary {
  Dual g, g1, g2;
};
Binary select_binary(Binary a, Binary b, bool take_b) {
  return Binary(select_dual(a.g, b.g, take_b), select_dual(a.g1, b.g1, take_b), select_dual(a.g2, b.g2, take_b));
}
Binary exchanged(Binary b) { return Binary(b.g, b.g2, b.g1); }

#endif
