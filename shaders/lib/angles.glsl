// Angles between directions, and the arctangent and tangent. Vulkan allows an atan an error of 4,096 ulp and a tan one
// of 2^-11, so both are polynomials here, through Chebyshev nodes in the square of their argument.
#ifndef ANGLES_GLSL
#define ANGLES_GLSL

const float PI = 3.14159265358979;

// The functions below sum the terms of a polynomial by pairs, because in a chain each step would wait for the one
// before.

// Returns arctan(t) / t, from the square of t within [0, 1].
float arctangent_ratio(float t2) {
  float s = 2.0 * t2 - 1.0, s2 = s * s, s4 = s2 * s2;
  float low = (0.870419741 - 0.10187643 * s) + (0.020851817 - 0.00503237359 * s) * s2;
  float high = (0.00131604378 - 0.000355648459 * s) + (0.000100659941 - 3.64540247e-05 * s + 1.08057948e-05 * s2) * s2;
  return low + high * s4;
}

// Returns the arctangent of t within [0, 1], with an error of at most 1e-7.
float arctangent(float t) { return t * arctangent_ratio(t * t); }

// Returns tan(theta) for theta within [0, pi/4], with an error of at most 1.5e-7.
float tangent(float theta) {
  float s = 3.24227788 * theta * theta - 1.0, s2 = s * s;
  float low = 1.11730146 + 0.1338626 * s, middle = 0.0189245138 + 0.00270001474 * s;
  float high = 0.000385682943 + 5.71377277e-05 * s + 8.16252577e-06 * s2;
  return theta * (low + (middle + high * s2) * s2);
}

// Returns the angle between two directions, within [0, pi]. Its error is at most 4e-7 where the product of their
// lengths is within [1e-9, 1e9]; where one of them vanishes the angle is arbitrary. It is computed from the cross and
// dot products, because an arccosine loses half of the digits of angles near 0 and pi.
float angle_between(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float x = dot(a, b), x2 = x * x, y2 = dot(normal, normal);
  bool is_upright = y2 > x2, is_behind = x < 0.0;
  float t2 = (is_upright ? x2 : y2) / ((is_upright ? y2 : x2) + 1e-37);
  float angle = sqrt(t2) * arctangent_ratio(t2);
  float from = is_upright ? 0.5 * PI : is_behind ? PI : 0.0;
  return from + (is_upright != is_behind ? -angle : angle);
}

// Returns the derivatives of the angle with respect to the unit vectors a and b, which turn apart about their common
// normal. They are 0 at the angles 0 and pi, where the angle is not differentiable.
mat2x3 angle_partials(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  normal /= sqrt(dot(normal, normal)) + 1e-19;
  return mat2x3(cross(a, normal), cross(normal, b));
}

#endif
