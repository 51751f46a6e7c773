// Cells across the faces of bricks.
#ifndef MESH_NEIGHBOURS_GLSL
#define MESH_NEIGHBOURS_GLSL

#include "mesh_constants.glsl"

const uint NO_BRICK = 0xffffffffu;

// Twelve a brick: -x, +x, -y, +y, -z, +z, then (-y, -z), (-z, -x), (-x, -y), and (+y, +z), (+z, +x), (+x, +y).
layout(std430, binding = 7) readonly buffer Neighbours { uint neighbours[]; };

// A cell by brick and number.
struct CellRef {
  uint brick;
  uint cell;
};

// The cell at `at` of brick b, whose coordinates may be one less or one more than the brick's own, in one coordinate or
// (both less, or both more) in two.
CellRef cell_ref(uint b, ivec3 at) {
  const int n = int(BRICK_CELLS);
  uint slot = 12u;
  if (at.x < 0) slot = at.y < 0 ? 8u : at.z < 0 ? 7u : 0u;
  else if (at.y < 0) slot = at.z < 0 ? 6u : 2u;
  else if (at.z < 0) slot = 4u;
  else if (at.x >= n) slot = at.y >= n ? 11u : at.z >= n ? 10u : 1u;
  else if (at.y >= n) slot = at.z >= n ? 9u : 3u;
  else if (at.z >= n) slot = 5u;
  uvec3 within = uvec3(at + n) % BRICK_CELLS;
  uint cell = within.x + BRICK_CELLS * (within.y + BRICK_CELLS * within.z);
  return CellRef(slot == 12u ? b : neighbours[12u * b + slot], cell);
}

#endif
