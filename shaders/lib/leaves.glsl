// Primitives: signed distance with its derivatives, and the soft field. Mirrors server/blobtree/primitives/distance.h by name;
// records as written by server/blobtree/tape/parameter_layout.cpp.
#ifndef LEAVES_GLSL
#define LEAVES_GLSL

#include "field.glsl"
#include "parameters.glsl"

// Coordinates beyond would overflow when squared; all supports lie within.
const float FARTHEST = 1e10;
vec3 within_reach(vec3 point) { return clamp(point, vec3(-FARTHEST), vec3(FARTHEST)); }

// A distance with its gradient and Hessian, in whatever frame.
struct Distance {
  float d;
  vec3 n;
#ifdef WITH_GRADIENT
  mat3 h;
#endif
};

float safe_inverse(float x) { return x > 1e-18 ? 1.0 / x : 0.0; }

// A signed primitive's field: the distance times minus the (negative) slope.
Field signed_field(Distance s, float slope) {
  Field a = zero_field();
  a.f = -slope * s.d;
  a.d = -slope * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    a.g = a.d;
    a.j = -slope * s.h;
  }
#endif
  return a;
}

// f = w(clamp(R0 + slope d, 0, 1)), w(r) = (1 - r^2)^3.
Field soften(Distance s, float slope) {
  if (has_signed_leaves() && slope < 0.0) return signed_field(s, slope);
  Field a = zero_field();
  float r = clamp(R0 + slope * s.d, 0.0, 1.0);
  float v = 1.0 - r * r;
  a.f = v * v * v;
  float w1 = -6.0 * r * v * v * slope;  // r = 0 and r = 1 give 0
  a.d = w1 * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) {
    float w2 = r > 0.0 ? -6.0 * v * (1.0 - 5.0 * r * r) * slope * slope : 0.0;
    a.g = a.d;
    a.j = w1 * s.h + w2 * outerProduct(s.n, s.n);
  }
#endif
  return a;
}

// Distance to the sphere around the origin of a space, with the unit direction.
Distance sphere_distance(vec3 v, float radius) {
  Distance s;
  float m = length(v);
  float inverse_m = safe_inverse(m);
  s.d = m - radius;
  s.n = v * inverse_m;
#ifdef WITH_GRADIENT
  s.h = inverse_m * (mat3(1.0) - outerProduct(s.n, s.n));
#endif
  return s;
}

// A round cone from the origin along the unit vector `axis`: the sphere of its family that the point sees.
Distance segment_distance(vec3 v, vec3 axis, float len, float radius, float slope, float tan_tilt) {
  float y = dot(v, axis);
  vec3 across = v - y * axis;
  float rho = length(across);
  float c = y - rho * tan_tilt;
  float foot = clamp(c, 0.0, len);
  Distance s = sphere_distance(v - foot * axis, radius + slope * foot);
#ifdef WITH_GRADIENT
  // Along the cone the distance is flat: take the curvature along its generatrix out.
  bool on_cone = c > 0.0 && c < len;
  vec3 t = (axis + slope * s.n) * inversesqrt(max(1.0 - slope * slope, 1e-12));
  float m = length(v - foot * axis);
  s.h -= (on_cone ? safe_inverse(m) : 0.0) * outerProduct(t, t);
#endif
  return s;
}

// A body of revolution around z from its profile in the (rho, z) half plane: distance, unit normal (n_rho, n_z) and
// curvature of the profile's level line.
Distance revolve(vec3 q, float rho, float d, vec2 n, float curvature) {
  Distance s;
  float inverse_rho = safe_inverse(rho);
  vec3 radial = vec3(q.xy * inverse_rho, 0.0);
  s.d = d;
  s.n = vec3(n.x * radial.xy, n.y);
#ifdef WITH_GRADIENT
  vec3 around = vec3(-radial.y, radial.x, 0.0);
  vec3 along = vec3(-n.y * radial.xy, n.x);
  s.h = curvature * outerProduct(along, along) + n.x * inverse_rho * outerProduct(around, around);
#endif
  return s;
}

Distance torus_distance(vec3 q, float major, float minor) {
  float rho = length(q.xy);
  vec2 w = vec2(rho - major, q.z);
  float m = length(w);
  float inverse_m = safe_inverse(m);
  return revolve(q, rho, m - minor, w * inverse_m, inverse_m);
}

Distance cylinder_distance(vec3 q, float half_length, float radius) {
  float rho = length(q.xy);
  vec2 e = vec2(rho - radius, abs(q.z) - half_length);
  float z_sign = q.z < 0.0 ? -1.0 : 1.0;
  bool corner = e.x > 0.0 && e.y > 0.0;
  float m = length(e);
  float inverse_m = corner ? safe_inverse(m) : 0.0;
  vec2 face = e.x > e.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
  vec2 n = corner ? e * inverse_m : face;
  return revolve(q, rho, corner ? m : max(e.x, e.y), vec2(n.x, n.y * z_sign), inverse_m);
}

Distance box_distance(vec3 q, vec3 half_size, float rounding) {
  vec3 side = vec3(q.x < 0.0 ? -1.0 : 1.0, q.y < 0.0 ? -1.0 : 1.0, q.z < 0.0 ? -1.0 : 1.0);
  vec3 e = abs(q) - half_size;
  float deepest = max(e.x, max(e.y, e.z));
  vec3 outside = max(e, vec3(0.0));
  float m = length(outside);
  float inverse_m = safe_inverse(m);
  bool inside = deepest <= 0.0;
  vec3 face = e.x >= deepest ? vec3(1.0, 0.0, 0.0) : e.y >= deepest ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  Distance s;
  s.d = (inside ? deepest : m) - rounding;
  vec3 n = inside ? face : outside * inverse_m;
  s.n = n * side;
#ifdef WITH_GRADIENT
  vec3 alive = vec3(e.x > 0.0 ? 1.0 : 0.0, e.y > 0.0 ? 1.0 : 0.0, e.z > 0.0 ? 1.0 : 0.0);
  mat3 diagonal = mat3(alive.x, 0.0, 0.0, 0.0, alive.y, 0.0, 0.0, 0.0, alive.z);
  s.h = (inside ? 0.0 : inverse_m) * (diagonal - outerProduct(s.n, s.n));
#endif
  return s;
}

// An affine leaf: the rows of its map to the shape's own frame, with three parameters beside them.
struct Placement {
  vec3 q;          // the point in the shape's frame
  mat3 to_world;   // of gradients: the transpose of the map
  vec3 size;
  float slope;
};

Placement place(vec3 p, uint record) {
  Pair first = leaf_pair_at(record), second = leaf_pair_at(record + 2u);
  vec4 anchor = first.a, r0 = first.b, r1 = second.a, r2 = second.b;
  vec3 v = p - anchor.xyz;
  // Scaled coordinates beyond would overflow when squared, too.
  vec3 q = clamp(vec3(dot(r0.xyz, v), dot(r1.xyz, v), dot(r2.xyz, v)), vec3(-1e19), vec3(1e19));
  return Placement(q, mat3(r0.xyz, r1.xyz, r2.xyz),
                   vec3(r0.w, r1.w, r2.w), anchor.w);
}

Field placed_field(Placement at, Distance s) {
  s.n = at.to_world * s.n;
#ifdef WITH_GRADIENT
  if (is_steered()) s.h = at.to_world * s.h * transpose(at.to_world);
#endif
  return soften(s, at.slope);
}

Field leaf_field(vec3 p, uint operand, uint record) {
  Field v = zero_field();
  IF_OPERAND(operand, OPERAND_SPHERE) {
    Pair sphere = leaf_pair_at(record);
    v = soften(sphere_distance(p - sphere.a.xyz, sphere.b.x), sphere.a.w);
  }
  IF_OPERAND(operand, OPERAND_SEGMENT) {
    Pair line = leaf_pair_at(record);
    vec4 cone = leaf_at(record + 2u);
    v = soften(segment_distance(p - line.a.xyz, line.b.xyz, line.b.w, cone.x, cone.y, cone.z), line.a.w);
  }
  IF_OPERAND(operand, OPERAND_BOX) {
    Placement at = place(p, record);
    v = placed_field(at, box_distance(at.q, at.size, leaf_at(record + 4u).x));
  }
  IF_OPERAND(operand, OPERAND_CYLINDER) {
    Placement at = place(p, record);
    v = placed_field(at, cylinder_distance(at.q, at.size.x, at.size.y));
  }
  IF_OPERAND(operand, OPERAND_TORUS) {
    Placement at = place(p, record);
    v = placed_field(at, torus_distance(at.q, at.size.x, at.size.y));
  }
  IF_OPERAND(operand, OPERAND_ELLIPSOID) {
    Placement at = place(p, record);
    v = placed_field(at, sphere_distance(at.q, at.size.x));
  }
  IF_OPERAND(operand, OPERAND_AFFINE_SEGMENT) {
    Placement at = place(p, record);
    float slope = at.size.z;
    float tan_tilt = -slope * inversesqrt(max(1.0 - slope * slope, 1e-12));
    v = placed_field(at, segment_distance(at.q, vec3(0.0, 0.0, 1.0), at.size.x, at.size.y, slope, tan_tilt));
  }
  return v;
}

#endif
