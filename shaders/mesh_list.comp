// Mesher, pass 5: lists every vertex with its cell and patch, and every quad with its edge. An invocation takes one
// brick.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_constants.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_MESH_SURFACE_CASES) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = BINDING_MESH_CELLS) readonly buffer Cells { uint cells_in[]; };
// The numbers of the first vertex and the first quad of each brick.
layout(std430, binding = BINDING_MESH_LIST_STARTS) readonly buffer Starts { uvec2 starts[]; };
// The vertices, in the form of mesh_constants.glsl.
layout(std430, binding = BINDING_MESH_LIST_VERTICES) writeonly buffer Vertices { uint vertex_list[]; };
// The quads: the brick, and cell | axis << 8 | inside << 10, where `inside` tells whether the edge's low end is inside.
layout(std430, binding = BINDING_MESH_QUADS) writeonly buffer Quads { uvec2 quad_list[]; };

void main() {
  uint b = gl_GlobalInvocationID.x;
  if (b >= count) return;
  uint vertex = starts[b].x, quad = starts[b].y;
  for (uint c = 0u; c < CELLS_PER_BRICK; ++c) {
    uint cell = cells_in[b * CELLS_PER_BRICK + c];
    uint inside = cell & 0xffu;
    if (inside != 0u && inside != 0xffu) {
      uint patches = case_patches(surface_cases[cell_case(cell)]);
      for (uint n = 0u; n < patches; ++n) vertex_list[vertex++] = c | n << 8u;
      for (uint axis = 0u; axis < 3u; ++axis) {
        if ((own_crossings(inside) >> axis & 1u) != 0u) {
          quad_list[quad++] = uvec2(b, c | axis << 8u | (inside & 1u) << 10u);
        }
      }
    }
  }
}
