// Mesher, pass 12: writes the triangles of each quad, counter-clockwise seen from outside, and the vertices in the
// middle of fans.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_quads.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_MESH_TRIANGLES_CUTS) readonly buffer Cuts { uint cuts[]; };  // cut | fans before << 2
layout(std430, binding = BINDING_MESH_TRIANGLES_TRIANGLES) writeonly buffer Triangles { uint triangles[]; };
layout(std430, binding = BINDING_MESH_TRIANGLES_FAN_STARTS) readonly buffer FanStarts { uvec2 fan_starts[]; };
// The positions of the fans' centres.
layout(std430, binding = BINDING_MESH_TRIANGLES_CENTRES) writeonly buffer Centres { float centres[]; };
layout(std430, binding = BINDING_MESH_TRIANGLES_CORNERS) readonly buffer Corners { uvec4 corners[]; };  // Quad::corners

void write_triangle(uint t, uint a, uint b, uint c) {
  triangles[3u * t] = a;
  triangles[3u * t + 1u] = b;
  triangles[3u * t + 2u] = c;
}

void main() {
  uint n = gl_GlobalInvocationID.x;  // within the slab
  if (n >= count) return;
  uint q = first + n;
  ListedQuad at = listed_quad(q);
  // The vertices are counter-clockwise about the axis, which is right if the surface faces along the axis.
  uvec4 v = corners[q];
  v = at.inside_low ? v : v.xwzy;
  uint cut = cuts[q] & 3u, fans = cuts[q] >> 2u;
  uint t = 2u * (n + fans - (cuts[first] >> 2u));
  if (cut != CUT_FAN) {
    bool across = cut == CUT_13;
    write_triangle(t, v.x, v.y, across ? v.w : v.z);
    write_triangle(t + 1u, across ? v.y : v.x, v.z, v.w);
  } else {
    // The centres of fans are numbered after the vertices of the brick's cells.
    uint centre = starts[at.brick + 1u].x - starts[at.brick].x + fans - fan_starts[at.brick].x;
    write_triangle(t, v.x, v.y, centre);
    write_triangle(t + 1u, v.y, v.z, centre);
    write_triangle(t + 2u, v.z, v.w, centre);
    write_triangle(t + 3u, v.w, v.x, centre);
    vec3 p = corner_position(brick(at.brick).at * BRICK_CELLS + at.at);
    p += clamp(crossing_place(q), MARGIN, 1.0 - MARGIN) * origin.w * vec3(axis_vector(at.axis));
    centres[3u * fans] = p.x;
    centres[3u * fans + 1u] = p.y;
    centres[3u * fans + 2u] = p.z;
  }
}
