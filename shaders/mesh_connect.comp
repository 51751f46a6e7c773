// Mesher, pass 4: numbers the vertices of each brick's cells and counts vertices and quads. An invocation takes one
// brick.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_neighbours.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_MESH_SURFACE_CASES) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = BINDING_MESH_CONNECT_CASES) readonly buffer Cases { uint cases[]; };
layout(std430, binding = BINDING_MESH_CONNECT_CELLS) writeonly buffer Cells { uint cells_out[]; };
layout(std430, binding = BINDING_MESH_CONNECT_COUNTS) writeonly buffer Counts { uvec2 counts[]; };  // vertices, quads

uint inside_corners(CellRef c) {
  return cases[c.brick * (CELLS_PER_BRICK / 4u) + c.cell / 4u] >> (8u * (c.cell % 4u)) & 0xffu;
}

void main() {
  uint b = gl_GlobalInvocationID.x;
  if (b >= count) return;
  uint vertices = 0u, quads = 0u;
  for (uint c = 0u; c < CELLS_PER_BRICK; ++c) {
    uint inside = inside_corners(CellRef(b, c));
    uint cell = inside;
    if (inside != 0u && inside != 0xffu) {
      uint doubt = surface_cases[inside].x >> 28u & 7u;
      if (doubt != 0u) {
        // If two cells that meet in an ambiguous face both had one patch on it, they would share two edges of the mesh
        // there. So both resolve the face the other way.
        uint face = doubt - 1u;
        ivec3 step = ivec3(axis_vector(face >> 1u)) * ((face & 1u) == 0u ? -1 : 1);
        CellRef other = cell_ref(b, ivec3(cell_in_brick(c)) + step);
        if (other.brick != NO_BRICK) {
          uint opposite = surface_cases[inside_corners(other)].x >> 28u & 7u;
          if (opposite == (face ^ 1u) + 1u) cell |= 0x100u;
        }
      }
      cell |= vertices << 16u | quads << 24u;
      vertices += case_patches(surface_cases[cell_case(cell)]);
      quads += uint(bitCount(own_crossings(inside)));
    }
    cells_out[b * CELLS_PER_BRICK + c] = cell;
  }
  counts[b] = uvec2(vertices, quads);
}
