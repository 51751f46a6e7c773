// Mesher, pass 7: two triangles a quad, counter-clockwise seen from outside.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_neighbours.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = 6) readonly buffer Cells { uint cells_in[]; };
layout(std430, binding = 8) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 9) readonly buffer Quads { uvec2 quad_list[]; };
layout(std430, binding = 10) readonly buffer Positions { float positions[]; };
layout(std430, binding = 11) writeonly buffer Triangles { uint triangles[]; };

vec3 position(uint v) { return vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]); }

// The vertex of the patch that holds the quad's edge in the cell at offset -(du, dv) from the edge.
uint quad_vertex(uint b, uvec3 at, uint axis, uint du, uint dv) {
  ivec3 where = ivec3(at) - int(du) * ivec3(axis_vector((axis + 1u) % 3u)) - int(dv) * ivec3(axis_vector((axis + 2u) % 3u));
  CellRef c = cell_ref(b, where);
  if (c.brick == NO_BRICK) return 0u;  // unreachable: a cell with a crossing edge is never culled
  uint cell = cells_in[c.brick * CELLS_PER_BRICK + c.cell];
  return starts[c.brick].x + cell_vertex(cell) + case_patch_of_edge(surface_cases[cell_case(cell)], 4u * axis + du + 2u * dv);
}

// The cosine of the angle between the triangles (a, b, c) and (a, c, d): the better diagonal bends the quad less.
float flatness(vec3 a, vec3 b, vec3 c, vec3 d) {
  vec3 n0 = cross(b - a, c - a), n1 = cross(c - a, d - a);
  return dot(n0, n1) * inversesqrt(max(dot(n0, n0) * dot(n1, n1), 1e-36));
}

void main() {
  uint q = gl_GlobalInvocationID.x;  // within the slab
  if (q >= count) return;
  uint b = quad_list[first + q].x, code = quad_list[first + q].y;
  uvec3 at = cell_in_brick(code & 0xffu);
  uint axis = code >> 8u & 3u;
  bool inside_low = (code >> 10u) != 0u;
  uint v0 = quad_vertex(b, at, axis, 0u, 0u);
  uint v1 = quad_vertex(b, at, axis, 1u, 0u);
  uint v2 = quad_vertex(b, at, axis, 1u, 1u);
  uint v3 = quad_vertex(b, at, axis, 0u, 1u);
  // Counter-clockwise about the axis as they stand: right when the surface faces along it.
  uint swap = v1;
  v1 = inside_low ? v1 : v3;
  v3 = inside_low ? v3 : swap;
  vec3 p0 = position(v0), p1 = position(v1), p2 = position(v2), p3 = position(v3);
  bool across = flatness(p1, p2, p3, p0) > flatness(p0, p1, p2, p3);
  uint t = 6u * q;
  triangles[t] = v0;
  triangles[t + 1u] = v1;
  triangles[t + 2u] = across ? v3 : v2;
  triangles[t + 3u] = across ? v1 : v0;
  triangles[t + 4u] = v2;
  triangles[t + 5u] = v3;
}
