// The numbering of corners, edges, cells and vertices that the mesher's passes share, and helpers that read their push
// constants.
//
// A cell's corners are numbered x + 2 y + 4 z, its edges 4 axis + u + 2 v with (u, v) the offsets along the next two
// axes in cyclic order. Its surface falls into patches, one vertex each (dual marching cubes):
// server/engine/mesh/surface_cases.h.
#ifndef MESH_CONSTANTS_GLSL
#define MESH_CONSTANTS_GLSL

#include "bricks.glsl"
#include "mesh_layout.glsl"  // server/engine/mesh/mesh_layout.h: the push constants, among others

// A sample that is so near to iso that rounding decides its side is given the side of a point beside the lattice point,
// in the same direction everywhere. So a face that lies in a plane of the lattice is on one side of all of the plane,
// and two solids that share the face are one. The direction leads upwards along each axis, into the brick that begins
// at the point, and is far from every plane whose normal has small whole numbers as coordinates. Only such samples are
// stored as `iso` or, on the inside, as `just_inside`, which is the next number above it.
const vec3 BESIDE = vec3(0.346, 0.534, 0.772);
bool is_on_surface(float f) { return f == iso || f == just_inside; }

// True if corners on the lattice's boundary count as outside.
bool is_capped() { return (flags & IS_CAPPED) != 0u; }
// The factor that makes the field greater inside: 1, or -1 for a signed field.
float inward() { return (flags & IS_SIGNED) != 0u ? -1.0 : 1.0; }
// True if the dispatch handles listed bricks instead of those from `first` on.
bool is_listed() { return (flags & IS_LISTED) != 0u; }
// True if corner i of the lattice counts as outside because it lies on the lattice's boundary.
bool is_cap(uvec3 i) { return is_capped() && (any(equal(i, uvec3(0u))) || any(greaterThanEqual(i, cells.xyz))); }
// The value that a corner on a capped boundary is given.
float cap_value() { return (flags & IS_SIGNED) != 0u ? iso - origin.w : 0.0; }

vec3 corner_position(uvec3 i) { return lattice_point(origin.xyz, vec3(origin.w), i); }

uvec3 cell_in_brick(uint c) {
  return uvec3(c % BRICK_CELLS, c / BRICK_CELLS % BRICK_CELLS, c / (BRICK_CELLS * BRICK_CELLS));
}

uvec3 corner_offset(uint corner) { return uvec3(corner & 1u, corner >> 1u & 1u, corner >> 2u); }

uvec3 axis_vector(uint axis) { return uvec3(axis == 0u ? 1u : 0u, axis == 1u ? 1u : 0u, axis == 2u ? 1u : 0u); }

// Returns the lower corner of an edge of a cell.
uvec3 edge_offset(uint edge) {
  uint axis = edge >> 2u;
  return (edge & 1u) * axis_vector((axis + 1u) % 3u) + (edge >> 1u & 1u) * axis_vector((axis + 2u) % 3u);
}
uint corner_number(uvec3 offset) { return offset.x + 2u * offset.y + 4u * offset.z; }

// Returns the place of a corner's sample within its brick.
uint sample_place(uvec3 corner) { return corner.x + BRICK_CORNERS * (corner.y + BRICK_CORNERS * corner.z); }

// A cell is stored by the connecting pass in one word: bits 0-7 are the inside corners, bit 8 is set if its ambiguous
// face is resolved the other way, bits 16-23 are the number of its first vertex in the brick, bits 24-31 that of its
// first quad.
uint cell_case(uint cell) { return cell & 0x1ffu; }
uint cell_vertex(uint cell) { return cell >> 16u & 0xffu; }
uint cell_quad(uint cell) { return cell >> 24u; }

// Returns one bit for each axis, set if the surface crosses the cell's edge at its low corner along that axis. `inside`
// has the cell's inside corners. Each crossed edge gets one quad.
uint own_crossings(uint inside) {
  uint low = inside & 1u;
  return (low ^ (inside >> 1u & 1u)) | (low ^ (inside >> 2u & 1u)) << 1u | (low ^ (inside >> 4u & 1u)) << 2u;
}

// A vertex is listed as one word: bits 0-7 are its cell in the brick, bits 8-9 its patch. Bit 10 is set if it lies on a
// cap at the lattice's boundary. Bit 11 is set if it lies on a crease; bits 12-23 are then three edges whose crossings
// face apart. Bit 24 is set if it shares its cell with other vertices, bit 25 if an edge that places it begins on the
// surface.
const uint VERTEX_ON_CAP = 1u << 10u;
const uint VERTEX_ON_CREASE = 1u << 11u;
const uint VERTEX_IS_CROWDED = 1u << 24u;
const uint VERTEX_BY_SURFACE = 1u << 25u;
uint vertex_cell(uint vertex) { return vertex & 0xffu; }
uint vertex_patch(uint vertex) { return vertex >> 8u & 3u; }
uint vertex_edge(uint vertex, uint n) { return vertex >> (12u + 4u * n) & 15u; }

// Vertices keep this distance from the faces of their cell, in cells, so that no two vertices coincide.
const float MARGIN = 2e-3;

// A case, which is a row of the table of surface cases, is packed like this. x holds the patch of edge e in bits 2 e,
// the number of patches in bits 24-26, and 1 + the face to be checked for a doubled edge in bits 28-30. y holds the
// edges of patches 0 and 1, 12 bits each, z those of patches 2 and 3.
uint case_patches(uvec4 c) { return c.x >> 24u & 7u; }
uint case_patch_of_edge(uvec4 c, uint edge) { return c.x >> (2u * edge) & 3u; }
uint case_edges(uvec4 c, uint patch_number) {
  uint pair = patch_number < 2u ? c.y : c.z;
  return (patch_number & 1u) == 0u ? pair & 0xfffu : pair >> 12u;
}

#endif
