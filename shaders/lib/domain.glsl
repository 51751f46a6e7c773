// The affine map from a point to the frame of a leaf's shape. A leaf is a placed primitive. Mirrors
// server/blobtree/primitives/domain.h.
#ifndef DOMAIN_GLSL
#define DOMAIN_GLSL

#include "parameters.glsl"

// A point in the frame of an affine leaf, with the leaf's map and parameters. A record holds the rows of the map and,
// in their fourth components, three parameters of the shape.
struct Placement {
  vec3 q;          // the point in the shape's frame
  mat3 to_world;   // maps gradients to the world: the transpose of the map
  vec3 size;
  float slope;
};

Placement place(vec3 p, uint record) {
  Pair first = leaf_pair_at(record), second = leaf_pair_at(record + 2u);
  vec4 anchor = first.a, r0 = first.b, r1 = second.a, r2 = second.b;
  vec3 v = p - anchor.xyz;
  // Larger scaled coordinates would overflow when they are squared.
  vec3 q = clamp(vec3(dot(r0.xyz, v), dot(r1.xyz, v), dot(r2.xyz, v)), vec3(-1e19), vec3(1e19));
  return Placement(q, mat3(r0.xyz, r1.xyz, r2.xyz),
                   vec3(r0.w, r1.w, r2.w), anchor.w);
}

#endif
