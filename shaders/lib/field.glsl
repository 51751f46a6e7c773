// The field that a node yields at a point: a value, the direction that steers gradient blends, and (WITH_GRADIENT) the
// gradient of the value and the Jacobian of the direction. Mirrors server/reference/.
#ifndef FIELD_GLSL
#define FIELD_GLSL

#include "codes.glsl"  // written at build time

// The constant r0 of positive primitives (distance.glsl): w(R0) = 0.5.
const float R0 = 0.45420201894740647;

struct Field {
  float f;
  // The steering direction: gradients of primitives, combined by the operators' partial derivatives with respect to
  // their fields. It is the gradient of f where no gradient blend lies below the node.
  vec3 d;
#ifdef WITH_GRADIENT
  vec3 g;  // gradient of f
  mat3 j;  // column i is the derivative of d with respect to coordinate i
#endif
};

#ifdef WITH_GRADIENT
Field zero_field() { return Field(0.0, vec3(0.0), vec3(0.0), mat3(0.0)); }
#else
Field zero_field() { return Field(0.0, vec3(0.0)); }
#endif

// The gradient of a field as returned to a client.
vec3 field_gradient(Field a) {
#ifdef WITH_GRADIENT
  return is_steered() ? a.g : a.d;
#else
  return a.d;
#endif
}

Field select_field(Field a, Field b, bool take_b) {
  Field r;
  r.f = take_b ? b.f : a.f;
  r.d = take_b ? b.d : a.d;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    r.g = take_b ? b.g : a.g;
    r.j[0] = take_b ? b.j[0] : a.j[0];
    r.j[1] = take_b ? b.j[1] : a.j[1];
    r.j[2] = take_b ? b.j[2] : a.j[2];
  }
#endif
  return r;
}

#endif
