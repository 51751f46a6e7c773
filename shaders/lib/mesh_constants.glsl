// The numbering that the mesher's passes share, and what follows from what they are told.
//
// A cell's corners are numbered x + 2 y + 4 z, its edges 4 axis + u + 2 v with (u, v) the offsets along the next two
// axes in cyclic order. Its surface falls into patches, one vertex each (dual marching cubes):
// server/engine/mesh/surface_cases.h.
#ifndef MESH_CONSTANTS_GLSL
#define MESH_CONSTANTS_GLSL

#include "bricks.glsl"
#include "mesh_layout.glsl"  // server/engine/mesh/mesh_layout.h: the push constants, among others

// Samples that rounding might have put on either side of the surface are on the side of a point beside the lattice
// point, the same way everywhere: so a face that lies in a plane of the lattice is on one side of all of it, and two
// solids that share the face are one. The way is upwards, within the brick that the point begins, and far from every
// plane whose normal has small whole numbers as coordinates. Such samples are stored as `iso` or, on the inside, as
// `just_inside`, the number above it, and no others are.
const vec3 BESIDE = vec3(0.346, 0.534, 0.772);
bool is_on_surface(float f) { return f == iso || f == just_inside; }

// Corners on the lattice's boundary count as outside.
bool is_capped() { return (flags & IS_CAPPED) != 0u; }
// 1, or -1 where the field is signed: what makes it greater inside.
float inward() { return (flags & IS_SIGNED) != 0u ? -1.0 : 1.0; }
// The dispatch is about listed bricks, not about those from `first` on.
bool is_listed() { return (flags & IS_LISTED) != 0u; }
// Whether corner i of the lattice counts as outside because it lies on its boundary.
bool is_cap(uvec3 i) { return is_capped() && (any(equal(i, uvec3(0u))) || any(greaterThanEqual(i, cells.xyz))); }
// What a corner on a capped boundary is taken to have.
float cap_value() { return (flags & IS_SIGNED) != 0u ? iso - origin.w : 0.0; }

vec3 corner_position(uvec3 i) { return lattice_point(origin.xyz, vec3(origin.w), i); }

uvec3 cell_in_brick(uint c) { return uvec3(c % BRICK_CELLS, c / BRICK_CELLS % BRICK_CELLS, c / (BRICK_CELLS * BRICK_CELLS)); }

uvec3 corner_offset(uint corner) { return uvec3(corner & 1u, corner >> 1u & 1u, corner >> 2u); }

uvec3 axis_vector(uint axis) { return uvec3(axis == 0u ? 1u : 0u, axis == 1u ? 1u : 0u, axis == 2u ? 1u : 0u); }

// The lower corner of an edge of a cell.
uvec3 edge_offset(uint edge) {
  uint axis = edge >> 2u;
  return (edge & 1u) * axis_vector((axis + 1u) % 3u) + (edge >> 1u & 1u) * axis_vector((axis + 2u) % 3u);
}
uint corner_number(uvec3 offset) { return offset.x + 2u * offset.y + 4u * offset.z; }

// Place of a corner's sample within its brick.
uint sample_place(uvec3 corner) { return corner.x + BRICK_CORNERS * (corner.y + BRICK_CORNERS * corner.z); }

// A cell as the connecting pass leaves it: bits 0-7 the inside corners, bit 8 whether its ambiguous face is resolved
// the other way, bits 16-23 the number of its first vertex in the brick, bits 24-31 that of its first quad.
uint cell_case(uint cell) { return cell & 0x1ffu; }
uint cell_vertex(uint cell) { return cell >> 16u & 0xffu; }
uint cell_quad(uint cell) { return cell >> 24u; }

// Which of the edges at the low corner of a cell with these inside corners the surface crosses, a bit an axis: a quad
// each.
uint own_crossings(uint inside) {
  uint low = inside & 1u;
  return (low ^ (inside >> 1u & 1u)) | (low ^ (inside >> 2u & 1u)) << 1u | (low ^ (inside >> 4u & 1u)) << 2u;
}

// A vertex as listed: bits 0-7 its cell in the brick, 8-9 its patch; bit 10 whether the lattice's boundary cuts it off,
// bit 11 whether it lies on a crease, and then in bits 12-23 three edges whose crossings face apart; bit 24 whether it
// shares its cell with others; bit 25 whether an edge that places it begins on the surface.
const uint VERTEX_ON_CAP = 1u << 10u;
const uint VERTEX_ON_CREASE = 1u << 11u;
const uint VERTEX_IS_CROWDED = 1u << 24u;
const uint VERTEX_BY_SURFACE = 1u << 25u;
uint vertex_cell(uint vertex) { return vertex & 0xffu; }
uint vertex_patch(uint vertex) { return vertex >> 8u & 3u; }
uint vertex_edge(uint vertex, uint n) { return vertex >> (12u + 4u * n) & 15u; }

// Vertices keep off the faces of their cell by this part of it, so that no two coincide.
const float MARGIN = 2e-3;

// Of a case: x: patch of edge e in bits 2 e, number of patches in bits 24-26, and 1 + the face to be checked for a
// doubled edge in bits 28-30; y: edges of patches 0 and 1, 12 bits each; z: of patches 2 and 3.
uint case_patches(uvec4 c) { return c.x >> 24u & 7u; }
uint case_patch_of_edge(uvec4 c, uint edge) { return c.x >> (2u * edge) & 3u; }
uint case_edges(uvec4 c, uint patch_number) {
  uint pair = patch_number < 2u ? c.y : c.z;
  return (patch_number & 1u) == 0u ? pair & 0xfffu : pair >> 12u;
}

#endif
