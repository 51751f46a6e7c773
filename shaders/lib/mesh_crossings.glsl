// The crossings of the surface with the lattice's edges and its normals there, and the point where the tangent planes
// at several crossings meet. Each quad has one crossing, stored under the quad's number.
#ifndef MESH_CROSSINGS_GLSL
#define MESH_CROSSINGS_GLSL

#include "mesh_neighbours.glsl"

layout(std430, binding = BINDING_MESH_CELLS) readonly buffer Cells { uint cells_in[]; };
layout(std430, binding = BINDING_MESH_STARTS) readonly buffer Starts { uvec2 starts[]; };
// The crossings of bricks with KNOWS_CROSSINGS. Each is a vector along the outward normal whose length is 1 + the place
// along the edge, within [0, 1]; it is longer by 2 if the inner end of the edge is on the surface.
layout(std430, binding = BINDING_MESH_CROSSINGS) readonly buffer Crossings { float crossings[]; };

struct Crossing {
  vec3 at;  // in cells, from the low corner of the cell that crossing_of() was given
  vec3 normal;
  bool begins_on_surface;
};

bool begins_on_surface(float crossing_length) { return crossing_length > 2.5; }
float place_along(float crossing_length) { return crossing_length - (begins_on_surface(crossing_length) ? 3.0 : 1.0); }

// Returns the crossing on a crossed edge of a cell. The edge's quad belongs to the cell that has the edge at its low
// corner.
Crossing crossing_of(uint b, uvec3 cell, uint edge) {
  uvec3 low = edge_offset(edge);
  uint axis = edge >> 2u;
  CellRef owner = cell_ref(b, ivec3(cell + low));
  // This is never reached, since a cell with a crossing edge is never culled.
  if (owner.brick == NO_BRICK) return Crossing(vec3(0.5), vec3(axis_vector(axis)), false);
  uint state = cells_in[owner.brick * CELLS_PER_BRICK + owner.cell];
  uint before = own_crossings(state) & ((1u << axis) - 1u);
  uint q = starts[owner.brick].y + cell_quad(state) + uint(bitCount(before));
  vec3 v = vec3(crossings[3u * q], crossings[3u * q + 1u], crossings[3u * q + 2u]);
  float len = length(v);
  return Crossing(vec3(low) + place_along(len) * vec3(axis_vector(axis)), v / len, begins_on_surface(len));
}

// SMOOTH is defined for kernels whose bricks may not have creases.
#ifdef SMOOTH
const bool MAY_HAVE_CREASES = false;
#else
const bool MAY_HAVE_CREASES = true;
#endif

// A set of planes, kept as the quadratic function that sums the squared distances of a point to them (a quadric error
// function). Distances are taken from some origin point.
struct Planes {
  vec3 xx_yy_zz, yz_zx_xy;  // the sum of n n', which is symmetric
  vec3 offset;              // the sum of n times the plane's distance from the origin along n
};
Planes no_planes() { return Planes(vec3(0.0), vec3(0.0), vec3(0.0)); }
void add_plane(inout Planes s, vec3 n, float distance) {
  s.xx_yy_zz += n * n;
  s.yz_zx_xy += n.yzx * n.zxy;
  s.offset += distance * n;
}
vec3 times(Planes s, vec3 v) { return s.xx_yy_zz * v + s.yz_zx_xy.zxy * v.yzx + s.yz_zx_xy.yzx * v.zxy; }

// Returns the step from the origin point, which is at `x` in the cell, in cells, to the point within the cell that is
// nearest to all planes (least squares). If the planes meet outside the cell, the point slides along the crease to the
// cell's face: coordinates that would leave the cell are held at the face, and the others are solved again. The
// damping, a fraction of the number of planes, keeps the point in place along directions that the planes leave free or
// almost free. A truncated pseudo-inverse does the same, but is not continuous and needs an eigen decomposition.
vec3 meeting_point(Planes s, vec3 x, float damping) {
  vec3 least = vec3(MARGIN) - x, most = vec3(1.0 - MARGIN) - x;
  float scale = dot(s.xx_yy_zz, vec3(1.0));
  vec3 held = vec3(0.0), free = vec3(1.0), step = vec3(0.0);
  for (int round = 0; round < 3; ++round) {
    vec3 d = mix(vec3(scale), s.xx_yy_zz + damping * scale, free);
    vec3 o = s.yz_zx_xy * free.yzx * free.zxy;
    vec3 rest = mix(scale * held, s.offset - times(s, held), free);
    vec3 column0 = vec3(d.x, o.z, o.y), column1 = vec3(o.z, d.y, o.x), column2 = vec3(o.y, o.x, d.z);
    vec3 c0 = cross(column1, column2), c1 = cross(column2, column0), c2 = cross(column0, column1);
    step = (rest.x * c0 + rest.y * c1 + rest.z * c2) / max(dot(column0, c0), 1e-30);
    vec3 within = clamp(step, least, most);
    bvec3 leaves = greaterThan(abs(step - within) * free, vec3(0.0));
    held = mix(held, within, leaves);
    free = mix(free, vec3(0.0), leaves);
    step = within;
  }
  return step;
}

#endif
