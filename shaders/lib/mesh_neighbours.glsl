// Finds cells that may lie beyond the faces or edges of a brick, in its neighbours.
#ifndef MESH_NEIGHBOURS_GLSL
#define MESH_NEIGHBOURS_GLSL

#include "mesh_constants.glsl"

// NEIGHBOURS entries for each brick: the neighbouring brick, or NO_BRICK.
layout(std430, binding = BINDING_MESH_NEIGHBOURS) readonly buffer Neighbours { uint neighbours[]; };

// A cell, named by its brick and its number in the brick.
struct CellRef {
  uint brick;
  uint cell;
};

// Returns the cell at `at`, counted from the low corner of brick b. One coordinate may lie one cell below or above the
// brick, or two may, both below or both above.
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
