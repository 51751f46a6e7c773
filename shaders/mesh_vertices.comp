// Mesher, pass 9: moves every vertex onto the surface. A workgroup takes one brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "interpreter.glsl"
#include "mesh_constants.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_CELLS) readonly buffer Cells { uint cells_in[]; };
layout(std430, binding = BINDING_MESH_VERTICES_SURFACE_CASES) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = BINDING_MESH_STARTS) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = BINDING_MESH_VERTICES) readonly buffer Vertices { uint vertex_list[]; };
layout(std430, binding = BINDING_MESH_POSITIONS) buffer Positions { float positions[]; };

const int NEWTON_STEPS = 5;
const int BISECTION_STEPS = 14;
// How far a vertex that shares its cell with others may move along each axis, in cells.
const float CROWDED_REACH = 0.2;

// Returns the step, shortened so that it is at most a cell's size along each axis.
vec3 limited(vec3 step, float size) {
  float longest = max(max(abs(step.x), abs(step.y)), abs(step.z));
  return step * (longest > size ? size / longest : 1.0);
}

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  Brick at = brick(b);
  uint end = starts[b + 1u].x;
  // All invocations of a subgroup stay in the loop, and surplus ones repeat the last vertex, because shared loads
  // (lib/parameters.glsl) need all of them active. The stride is not gl_SubgroupSize, since a driver may run fewer
  // invocations together than that says.
  for (uint own = starts[b].x + gl_LocalInvocationID.x; subgroupAny(own < end); own += gl_WorkGroupSize.x) {
    uint v = min(own, end - 1u);
    uint vertex = vertex_list[v];
    uvec3 base = at.at * BRICK_CELLS + cell_in_brick(vertex_cell(vertex));
    uint state = cells_in[b * CELLS_PER_BRICK + vertex_cell(vertex)];
    float size = origin.w;
    vec3 low = corner_position(base);
    vec3 least = low + vec3(MARGIN * size), most = low + vec3((1.0 - MARGIN) * size);
    vec3 p = vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]);

    // `inside` and `outside` are corners of the patch on either side of the surface.
    uint edge = uint(findLSB(case_edges(surface_cases[cell_case(state)], vertex_patch(vertex))));
    uvec3 low_end = edge_offset(edge), high_end = low_end + axis_vector(edge >> 2u);
    bool inside_low = (state >> corner_number(low_end) & 1u) != 0u;
    vec3 inside = clamp(corner_position(base + (inside_low ? low_end : high_end)), least, most);
    vec3 outside = clamp(corner_position(base + (inside_low ? high_end : low_end)), least, most);

    // If several patches share a cell, each vertex stays near the mean of its own crossings, away from the other
    // vertices; if it can't reach the surface there, it is placed by one of its patch's edges.
    bool is_crowded = (vertex & VERTEX_IS_CROWDED) != 0u;
    least = is_crowded ? max(least, p - CROWDED_REACH * size) : least;
    most = is_crowded ? min(most, p + CROWDED_REACH * size) : most;

    // A vertex on a crease that lies in its cell's face keeps its margin to the face, and its cell may hold none of the
    // solid.
    const uint IN_FACE = VERTEX_ON_CREASE | VERTEX_BY_SURFACE;
    bool keeps_off = (vertex & IN_FACE) == IN_FACE;

    // Newton's method along the gradient, within the cell. If it does not converge, bisection follows between the last
    // point and the corner on the other side.
    vec3 inner = inside, outer = outside;
    bool done = (vertex & VERTEX_ON_CAP) != 0u;
    for (int step = 0; step < NEWTON_STEPS + BISECTION_STEPS && subgroupAny(!done); ++step) {
      Field a = evaluate(p, at.tape_begin, at.tape_count);
      a.d *= inward();
      float excess = inward() * a.f - iso;
      float slope2 = dot(a.d, a.d);
      vec3 newton = p + limited(-excess / max(slope2, 1e-30) * a.d, size);
      // Coordinates that would leave the cell are held at its faces, and the other coordinates make up for it.
      // Otherwise such a vertex would wait for the bisection, and its subgroup with it; measured, that made this pass
      // slower.
      vec3 held = clamp(newton, least, most);
      bvec3 is_held = notEqual(held, newton);
      vec3 d_held = mix(vec3(0.0), a.d, is_held), d_free = a.d - d_held;
      // The bound keeps the vertex in place if all of the gradient but rounding is held: the step would lead along the
      // surface, to the end of the cell.
      float free2 = max(dot(d_free, d_free), max(1e-6 * slope2, 1e-30));
      vec3 along = -(excess + dot(d_held, held - p)) / free2 * d_free;
      newton = clamp(mix(p + limited(along, size), held, is_held), least, most);
      // A vertex is stuck if the surface lies between the cell's face and the margin, where the vertex can't come
      // closer.
      vec3 moved = abs(newton - p);
      bool is_stuck = max(max(moved.x, moved.y), moved.z) <= tolerance * size;
      float allowed = is_stuck || keeps_off ? max(tolerance, 2.0 * MARGIN) : tolerance;
      done = done || abs(excess) <= allowed * size * sqrt(slope2);
      if (excess > 0.0) inner = p; else outer = p;
      if (step == NEWTON_STEPS - 1) {
        // The bisection keeps the side that p is on, and starts from the patch's own corner on the other side.
        if (excess > 0.0 || is_crowded) outer = outside;
        if (excess <= 0.0 || is_crowded) inner = inside;
      }
      vec3 next = step < NEWTON_STEPS - 1 ? newton : 0.5 * (inner + outer);
      p = done ? p : next;
    }
    positions[3u * v] = p.x;
    positions[3u * v + 1u] = p.y;
    positions[3u * v + 2u] = p.z;
  }
}
