// The bricks of a lattice and their tapes, as server/blobtree/cull/lattice.h lays them out.
#ifndef BRICKS_GLSL
#define BRICKS_GLSL

#include "bindings.glsl"
#include "sizes.glsl"

const uint BRICK_CORNERS = BRICK_CELLS + 1u;
const uint CELLS_PER_BRICK = BRICK_CELLS * BRICK_CELLS * BRICK_CELLS;
const uint CORNERS_PER_BRICK = BRICK_CORNERS * BRICK_CORNERS * BRICK_CORNERS;

struct Brick {
  uvec3 at;  // place in the lattice, in bricks
  uint tape_begin, tape_count;
};

layout(std430, binding = BINDING_LATTICE_BRICKS) readonly buffer Bricks { uint bricks[]; };

Brick brick(uint b) {
  uint i = BRICK_WORDS * b;
  return Brick(uvec3(bricks[i], bricks[i + 1u], bricks[i + 2u]), bricks[i + 3u], bricks[i + 4u]);
}

// Returns the position of lattice point i. It has the same bits for all bricks that share the point.
vec3 lattice_point(vec3 origin, vec3 spacing, uvec3 i) { return origin + spacing * vec3(i); }

#endif
