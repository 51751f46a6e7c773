// Cones with flat ends. Mirrors server/blobtree/primitives/cone.h.
#ifndef CONE_GLSL
#define CONE_GLSL

#include "distance.glsl"

// The distance to a cone around the z axis. `size` holds half the length and the radii at the lower and the upper end.
// `side` holds the outward normal of the side's line in the half-plane of (rho, z), and the length of that line.
Distance cone_distance(vec3 q, vec3 size, vec3 side) {
  float rho = length(q.xy);
  vec2 from_a = vec2(rho - size.y, q.z + size.x), from_b = vec2(rho - size.z, q.z - size.x);
  float off_side = dot(from_a, side.xy), along_side = from_a.y * side.x - from_a.x * side.y;
  float deepest = max(off_side, max(from_b.y, -from_a.y));
  bool is_above = from_b.y > 0.0 && from_b.x <= 0.0, is_below = from_a.y < 0.0 && from_a.x <= 0.0;
  bool is_beside = !is_above && !is_below && deepest > 0.0;
  bool at_a = is_beside && along_side <= 0.0, at_b = is_beside && !at_a && along_side >= side.z;
  vec2 from_rim = at_a ? from_a : from_b;
  float m = length(from_rim), inverse_m = at_a || at_b ? safe_inverse(m) : 0.0;
  // The face that the distance is measured to if no rim is nearest. For a point inside it is the nearest face.
  bool is_side = is_beside || (deepest <= 0.0 && off_side >= deepest);
  bool is_top = is_above || (!is_below && from_b.y >= deepest);
  vec2 face = is_side ? side.xy : vec2(0.0, is_top ? 1.0 : -1.0);
  float d = is_above ? from_b.y : is_below ? -from_a.y : is_beside ? off_side : deepest;
  return revolve(q, rho, at_a || at_b ? m : d, at_a || at_b ? from_rim * inverse_m : face, inverse_m);
}

Field cone_field(vec3 p, uint record) {
  Placement at = place(p, record);
  return placed_field(at, cone_distance(at.q, at.size, leaf_at(record + 4u).xyz));
}

#endif
