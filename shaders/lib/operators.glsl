// Composition operators on fields. Mirrors server/reference/ by name; definitions in proto/isofield/v1/scene.proto.
#ifndef OPERATORS_GLSL
#define OPERATORS_GLSL

#include "gradient_blend.glsl"

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

// max(0, min(a, 1 - b)).
Field subtract(Field a, Field b) {
  b.f = 1.0 - b.f;
  b.d = -b.d;
#ifdef WITH_GRADIENT
  b.g = -b.g;
  b.j = -b.j;
#endif
  Field r = select_field(a, b, b.f < a.f);
  return select_field(r, zero_field(), r.f <= 0.0);
}

#ifdef WITH_GRADIENT
// Joins gradients and Jacobians of an operator g(f1, f2) steered by nothing: d_g = g1 d1 + g2 d2.
void join_derivatives(inout Field r, Field a, Field b, float g1, float g2, vec3 g1_v, vec3 g2_v) {
  r.j = g1 * a.j + g2 * b.j + outerProduct(a.d, g1_v) + outerProduct(b.d, g2_v);
}
#endif

// (a^t + b^t)^(1/t), with the larger field taken out so that no power under- or overflows.
Field ricci(Field a, Field b, vec2 exponent) {
  float t = exponent.x;
  float hi = max(a.f, b.f), lo = min(a.f, b.f);
  float ratio = hi > 0.0 ? lo / hi : 0.0;
  float power = ratio > 0.0 ? exp2(t * log2(ratio)) : 0.0;
  float g = hi * (power > 0.0 ? exp2(exponent.y * log2(1.0 + power)) : 1.0);
  float inverse = g > 0.0 ? 1.0 / g : 0.0;
  float x = a.f * inverse, y = b.f * inverse;
  float x1 = x > 0.0 ? exp2((t - 1.0) * log2(x)) : 0.0;
  float y1 = y > 0.0 ? exp2((t - 1.0) * log2(y)) : 0.0;
  // A field of 0 leaves the other untouched, to the bit; at t = 1 both weights are 1.
  x1 = b.f <= 0.0 || t == 1.0 ? 1.0 : x1;
  y1 = a.f <= 0.0 || t == 1.0 ? 1.0 : y1;
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

// arccosine for x within [-1, 1] to 2e-8 (polynomial of Abramowitz and Stegun 4.4.46); the driver's own is allowed 4,096 ulp.
float arccosine(float x) {
  float y = abs(x);
  float p = -0.0012624911;
  p = p * y + 0.0066700901;
  p = p * y - 0.0170881256;
  p = p * y + 0.0308918810;
  p = p * y - 0.0501743046;
  p = p * y + 0.0889789874;
  p = p * y - 0.2145988016;
  p = p * y + 1.5707963050;
  float angle = sqrt(max(1.0 - y, 0.0)) * p;
  return x < 0.0 ? 3.14159265358979 - angle : angle;
}

// Below this square of a gradient (times the operation's length) it counts as vanishing, [G] section 7.
const float NULL_GRADIENT = 1e-3;

// 1 where a gradient is there, 0 where it vanishes, with the derivative with respect to the squared norm.
vec2 gradient_presence(float n) {
  float s = clamp(n / NULL_GRADIENT, 0.0, 1.0);
  return vec2(s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / NULL_GRADIENT);
}

// [G] eqs. 15 to 24, steered by the angle between the operands' directions; the gradient is the whole of eq. 29.
Field blend_by_gradient(Field a, Field b, vec4 operation, uint silhouette) {
  uint opening = floatBitsToUint(operation.x);
  float t_min = operation.z;
  float h = operation.w;
  vec3 d1 = a.d * h, d2 = b.d * h;
  float n1 = dot(d1, d1), n2 = dot(d2, d2);
  float inverse1 = inversesqrt(max(n1, 1e-12)), inverse2 = inversesqrt(max(n2, 1e-12));
  float cosine = clamp(dot(d1, d2) * inverse1 * inverse2, -1.0, 1.0);
  vec3 open = opening_tangent(opening, arccosine(cosine));
  vec2 w1 = gradient_presence(n1), w2 = gradient_presence(n2);
  float t = t_min + (open.x - t_min) * w1.x * w2.x;

  Blend g = gradient_blend(a.f, b.f, t, silhouette);
  Field r = zero_field();
  r.f = g.g;
  r.d = g.g1 * a.d + g.g2 * b.d;
#ifdef WITH_GRADIENT
  // Gradient of t: through the angle, and through the presence of either gradient.
  vec3 n1_v = 2.0 * h * (d1 * a.j), n2_v = 2.0 * h * (d2 * b.j);
  vec3 cosine_v = h * inverse1 * inverse2 * (d2 * a.j + d1 * b.j) -
                  0.5 * cosine * (inverse1 * inverse1 * n1_v + inverse2 * inverse2 * n2_v);
  // Openings are flat at 0 and pi, where the angle has no gradient.
  float sine2 = 1.0 - cosine * cosine;
  vec3 angle_v = sine2 > 1e-6 ? -inversesqrt(sine2) * cosine_v : vec3(0.0);
  vec3 t_v = (w1.x * w2.x) * open.y * angle_v + (open.x - t_min) * (w1.y * w2.x * n1_v + w1.x * w2.y * n2_v);
  r.g = g.g1 * a.g + g.g2 * b.g + g.gt * t_v;
  join_derivatives(r, a, b, g.g1, g.g2, g.g11 * a.g + g.g12 * b.g + g.g1t * t_v,
                   g.g12 * a.g + g.g22 * b.g + g.g2t * t_v);
#endif
  // A field of 0 bypasses the operator.
  r = select_field(r, a, b.f <= 0.0);
  return select_field(r, b, a.f <= 0.0);
}

#endif
