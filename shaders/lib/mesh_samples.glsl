// The samples of a brick in octets, which are groups of eight corners (server/engine/mesh/mesh_samples.h).
#ifndef MESH_SAMPLES_GLSL
#define MESH_SAMPLES_GLSL

#include "mesh_constants.glsl"

// Returns corner n of an octet. Octets 0 to 7 hold the corners that are the brick's own. Octets 8 to 13 hold the upper
// faces without their upper edges, two octets a face. Octet 14 holds the edges at the upper x and y, and at the upper x
// and z. Octet 15 holds the edge at the upper y and z, and the last corner four times.
uvec3 corner_of_octet(uint octet, uint n) {
  uint m = (octet & 1u) * OCTET_CORNERS + n, u = m % BRICK_CELLS, v = m / BRICK_CELLS;
  uint k = n % BRICK_CELLS;
  bool is_first = n < BRICK_CELLS;
  if (octet < OWN_OCTETS) return uvec3(u, v % BRICK_CELLS, octet / 2u);
  if (octet < 10u) return uvec3(BRICK_CELLS, u, v);
  if (octet < 12u) return uvec3(u, BRICK_CELLS, v);
  if (octet < 14u) return uvec3(u, v, BRICK_CELLS);
  if (octet == 14u) return is_first ? uvec3(BRICK_CELLS, BRICK_CELLS, k) : uvec3(BRICK_CELLS, k, BRICK_CELLS);
  return is_first ? uvec3(k, BRICK_CELLS, BRICK_CELLS) : uvec3(BRICK_CELLS);
}

#endif
