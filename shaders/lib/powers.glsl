// Powers x^t with a relative error of 4e-7 for t up to 64. Vulkan allows exp2(t log2(x)), and so pow(), fifty times as
// much: an error of 2^-21 in the logarithm, which t multiplies, and of 3 + 2 |y| units in the last place in exp2(y).
// Here the logarithm, and its product with t, are sums of two floats, and both functions are polynomials
// (server/operators/polynomial.h).
#ifndef POWERS_GLSL
#define POWERS_GLSL

#include "polynomials.glsl"  // written at build time

// Returns the leading 12 bits of a number. The product of two such numbers is exact in float32.
float leading(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

// Returns log2(x) for x > 0 as a sum of two floats, with an error of at most 8e-9; the first float has 12 bits.
// `precise` keeps the compiler from rearranging the sums.
vec2 logarithm(float x) {
  int exponent = (floatBitsToInt(x) - 0x3f3504f3) >> 23;  // x = 2^exponent (1 + f), 1 + f within [1/sqrt(2), sqrt(2)[
  precise float f = intBitsToFloat(floatBitsToInt(x) - (exponent << 23)) - 1.0;
  // g1 + g2 is f - f^2/2 in two parts.
  precise float f1 = leading(f), f2 = f - f1, half_square = 0.5 * f1 * f1;
  precise float g = f - half_square, g1 = leading(g);
  precise float g2 = ((f - g1) - half_square) - 0.5 * f2 * (f + f1);
  // log2(e) is a sum of two floats, the first with 12 bits.
  precise float head = 1.4423828125 * g1;
  precise float tail =
      3.122283889634e-4 * g1 + 1.44269504 * g2 + f * f * f * logarithm_value(2.82842712 * f - 0.171572875);
  precise float sum = (float(exponent) + head) + tail, high = leading(sum);
  precise float low = ((float(exponent) - high) + head) + tail;
  return vec2(high, low);
}

// Returns (x (1 + tail))^t for x > 0. `tail` is the relative part of the base that float32 has no room for in x. The
// result is exactly 1 for t = 0 and for x = 1, and 0 below 2^-126; results above 2^127 are not supported.
float power_of(float x, float tail, float t) {
  vec2 base = logarithm(x);
  base.y += 1.44269504 * tail;
  precise float t1 = leading(t), t2 = t - t1;
  precise float y1 = t1 * base.x, y2 = t * base.y + t2 * base.x;
  precise float whole = clamp(floor(y1 + y2 + 0.5), -127.0, 127.0);
  precise float part = (y1 - whole) + y2;
  float power = intBitsToFloat((int(whole) + 127) << 23);  // 2^-127 is 0
  return power * exponential_value(2.0 * clamp(part, -0.5, 0.5));
}

#endif
