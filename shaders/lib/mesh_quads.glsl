// A quad: the four vertices around an edge that the surface crosses.
#ifndef MESH_QUADS_GLSL
#define MESH_QUADS_GLSL

#include "mesh_crossings.glsl"

layout(std430, binding = BINDING_MESH_SURFACE_CASES) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = BINDING_MESH_QUADS) readonly buffer Quads { uvec2 quad_list[]; };

struct ListedQuad {
  uint brick;
  uvec3 at;  // the cell in the brick that has its edge at its low corner
  uint axis;
  bool inside_low;
};
struct Quad {
  ListedQuad edge;
  uvec4 vertices;  // counter-clockwise about the axis, from the cell at `at`
  // The same vertices as triangles name them: bits 0-23 are the number in the brick, bits 24-26 are set for the
  // coordinates in which that brick is one less than the quad's.
  uvec4 corners;
};

// Returns the cell at the offset -(du, dv) from the cell at `at`, along the next two axes in cyclic order.
ivec3 quad_cell(uvec3 at, uint axis, uint du, uint dv) {
  return ivec3(at) - int(du) * ivec3(axis_vector((axis + 1u) % 3u)) - int(dv) * ivec3(axis_vector((axis + 2u) % 3u));
}

// Returns the vertex of the patch that holds the quad's edge in that cell: its number, and its corner.
uvec2 quad_vertex(uint b, uvec3 at, uint axis, uint du, uint dv) {
  ivec3 where = quad_cell(at, axis, du, dv);
  CellRef c = cell_ref(b, where);
  if (c.brick == NO_BRICK) return uvec2(0u);  // unreachable: a cell with a crossing edge is never culled
  uint cell = cells_in[c.brick * CELLS_PER_BRICK + c.cell];
  uint number = cell_vertex(cell) + case_patch_of_edge(surface_cases[cell_case(cell)], 4u * axis + du + 2u * dv);
  uint below = (where.x < 0 ? 1u : 0u) | (where.y < 0 ? 2u : 0u) | (where.z < 0 ? 4u : 0u);
  return uvec2(starts[c.brick].x + number, number | below << 24u);
}

ListedQuad listed_quad(uint q) {
  uvec2 listed = quad_list[q];
  return ListedQuad(listed.x, cell_in_brick(listed.y & 0xffu), listed.y >> 8u & 3u, (listed.y >> 10u) != 0u);
}

Quad quad(uint q) {
  ListedQuad e = listed_quad(q);
  uvec2 v0 = quad_vertex(e.brick, e.at, e.axis, 0u, 0u), v1 = quad_vertex(e.brick, e.at, e.axis, 1u, 0u),
        v2 = quad_vertex(e.brick, e.at, e.axis, 1u, 1u), v3 = quad_vertex(e.brick, e.at, e.axis, 0u, 1u);
  return Quad(e, uvec4(v0.x, v1.x, v2.x, v3.x), uvec4(v0.y, v1.y, v2.y, v3.y));
}

// Returns the place where the surface crosses the quad's edge, in cells from the edge's low end.
float crossing_place(uint q) {
  return place_along(length(vec3(crossings[3u * q], crossings[3u * q + 1u], crossings[3u * q + 2u])));
}

#endif
