// Mesher, pass 11: decides how each quad is cut into triangles.
//
// The envelope of a quad is the union of the tetrahedra that the quad's edge spans with two consecutive vertices each.
// If all triangles lie within their envelopes, triangles of different quads meet only where they share vertices,
// because envelopes of different edges have no inner point in common if the vertices lie in their cells (Ju and Udeshi,
// "Intersection-free contouring on an octree grid", 2006). A fan around the crossing of the edge always lies within the
// envelope; a pair of triangles is taken where it does too.
//
// SMOOTH is defined for meshes in which no brick may have creases.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_quads.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_MESH_POSITIONS) readonly buffer Positions { float positions[]; };
layout(std430, binding = BINDING_MESH_QUADS_CUTS) writeonly buffer Cuts { uint cuts[]; };
layout(std430, binding = BINDING_MESH_QUADS_KINDS) readonly buffer Kinds { uint kinds[]; };
layout(std430, binding = BINDING_MESH_QUADS_CORNERS) writeonly buffer Corners { uvec4 corners[]; };  // Quad::corners

// How far within the envelope a pair of triangles must lie, as a fraction of the envelope's size.
const float SLACK = 1e-3;
// The cost of a right angle between two triangles, beside the distance from the crossing, in cells, where that is
// known.
const float BEND = 0.02;
const float REFUSED = 1e30;

// Returns a vertex's position from the low end of the edge, in cells, along the next two axes in cyclic order and then
// along the edge's axis.
vec3 place(uint v, vec3 edge, uint axis) {
  vec3 p = (vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]) - edge) / origin.w;
  return axis == 0u ? p.yzx : axis == 1u ? p.zxy : p;
}

float turn(vec3 a, vec3 b) { return a.x * b.y - a.y * b.x; }

// Returns the cost of cutting the quad a, b, c, d along a c, which grows with the distance between its triangles and
// the crossing on the edge, and with their bend. Seen along the edge, the vertices lie around it counter-clockwise. So
// the triangles and the envelope are linear between the edge, the vertices, and the point where the diagonal crosses
// the ray from the edge to b or d.
float cost(vec3 a, vec3 b, vec3 c, vec3 d, float crossing, bool knows_crossing) {
  vec3 n0 = cross(b - a, c - a), n1 = cross(c - a, d - a);
  float flatness = dot(n0, n1) * inversesqrt(max(dot(n0, n0) * dot(n1, n1), 1e-36));
  // The points are renamed so that the diagonal passes between the edge and the second of them.
  bool swapped = turn(a, c) < 0.0;
  vec3 p = swapped ? c : a, q = swapped ? d : b, r = swapped ? a : c, s = swapped ? b : d;
  float pq = turn(p, q), qr = turn(q, r), pr = turn(p, r), rs = turn(r, s), sp = turn(s, p);
  float along_ray = pr / (pq + qr), along_diagonal = pq / (pq + qr);
  float room = 1.0 - along_ray;
  float over_ray = mix(p.z, r.z, along_diagonal) - along_ray * q.z;
  float on_edge = (rs * p.z + sp * r.z + pr * s.z) / (rs + sp + pr);
  bool is_within = room > SLACK && over_ray > SLACK * room && over_ray < (1.0 - SLACK) * room && on_edge > SLACK &&
                   on_edge < 1.0 - SLACK;
  return is_within ? (knows_crossing ? abs(on_edge - crossing) : 0.0) + BEND * (1.0 - flatness) : REFUSED;
}

// True if a vertex of the quad lies in a brick that may have creases. Neighbours without vertices do not affect the
// quad.
bool may_crease_around(Quad q) {
  if (!MAY_HAVE_CREASES || (kinds[q.edge.brick] & KNOWS_CROSSINGS) == 0u) return false;
  bool may_crease = false;
  for (uint i = 0u; i < 4u; ++i) {
    CellRef c = cell_ref(q.edge.brick, quad_cell(q.edge.at, q.edge.axis, i & 1u, i >> 1u));
    may_crease = may_crease || (c.brick != NO_BRICK && (kinds[c.brick] & MAY_CREASE) != 0u);
  }
  return may_crease;
}

void main() {
  uint n = gl_GlobalInvocationID.x;  // within the slab
  if (n >= count) return;
  uint q = first + n;
  Quad at = quad(q);
  corners[q] = at.corners;
  vec3 edge = corner_position(brick(at.edge.brick).at * BRICK_CELLS + at.edge.at);
  vec3 p0 = place(at.vertices.x, edge, at.edge.axis), p1 = place(at.vertices.y, edge, at.edge.axis),
       p2 = place(at.vertices.z, edge, at.edge.axis), p3 = place(at.vertices.w, edge, at.edge.axis);
  bool knows_crossing = may_crease_around(at);
  float crossing = knows_crossing ? crossing_place(q) : 0.0;
  float cost02 = cost(p0, p1, p2, p3, crossing, knows_crossing);
  float cost13 = cost(p1, p2, p3, p0, crossing, knows_crossing);
  cuts[q] = min(cost02, cost13) >= REFUSED ? CUT_FAN : cost13 < cost02 ? CUT_13 : CUT_02;
}
