// Cells across the faces of bricks.
#ifndef MESH_NEIGHBOURS_GLSL
#define MESH_NEIGHBOURS_GLSL

#include "mesh_constants.glsl"

// NEIGHBOURS a brick, or NO_BRICK.
layout(std430, binding = BINDING_MESH_NEIGHBOURS) readonly buffer Neighbours { uint neighbours[]; };

// A cell by brick and number.
struct CellRef {
  uint brick;
  uint cell;
};

// The cell at `at` of brick b, whose coordinates may be one less or one more than the brick's own, in one coordinate or
// (both less, or both more) in two.
CellRef cell_ref(uint b, ivec3 at) {
  const int n = int(BRICK_CELLS);
  uint slot = NEIGHBOURS;
  if (at.x < 0) slot = at.y < 0 ? BELOW_XY : at.z < 0 ? BELOW_XZ : BELOW_X;
  else if (at.y < 0) slot = at.z < 0 ? BELOW_YZ : BELOW_Y;
  else if (at.z < 0) slot = BELOW_Z;
  else if (at.x >= n) slot = at.y >= n ? ABOVE_XY : at.z >= n ? ABOVE_XZ : ABOVE_X;
  else if (at.y >= n) slot = at.z >= n ? ABOVE_YZ : ABOVE_Y;
  else if (at.z >= n) slot = ABOVE_Z;
  uvec3 within = uvec3(at + n) % BRICK_CELLS;
  uint cell = within.x + BRICK_CELLS * (within.y + BRICK_CELLS * within.z);
  return CellRef(slot == NEIGHBOURS ? b : neighbours[NEIGHBOURS * b + slot], cell);
}

#endif
