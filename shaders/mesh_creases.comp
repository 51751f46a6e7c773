// Mesher, pass 8: moves the vertices on creases to where the sides of the crease meet. A workgroup takes one brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "interpreter.glsl"
#include "mesh_crossings.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_VERTICES) readonly buffer Vertices { uint vertex_list[]; };
layout(std430, binding = BINDING_MESH_POSITIONS) buffer Positions { float positions[]; };

// Each round evaluates the tangent planes anew, at points on the way from the vertex to a crossing on every side, at
// these fractions of the way. The error from the curvature of a side falls with the square of that distance; the
// difference between a steering direction and the gradient falls with the distance.
const int ROUNDS = 3;
const float FIRST_PULL = 0.35, PULL = 0.07;
// The points also lie a little further out of the cell along the side, by this distance in cells: where the crease lies
// in a face, a side may lie beyond it. In the first round the distance is larger if a side lies in the cell's face,
// because all of the solid may lie beyond it.
const float BEYOND = 0.1, BEYOND_FACE = 0.3;
// The damping of the meeting point. It is small, because the way along which a face that holds the vertex leaves it may
// meet a side at an angle of a few degrees.
const float DAMPING = 1e-4;
// A third side may end the crease within the cell without crossing any of the cell's edges. It is looked for where the
// crease would leave the cell. It counts if it has cut the surface off there by more than LEAST_CUT, in cells, and
// stands across the crease with a cosine above LEAST_ACROSS.
const float LEAST_CUT = 0.02, LEAST_ACROSS = 0.35;

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  Brick at = brick(b);
  uint end = starts[b + 1u].x;
  // All invocations of a subgroup stay in the loop, as mesh_vertices.comp explains: surplus ones repeat the last
  // vertex.
  for (uint own = starts[b].x + gl_LocalInvocationID.x; subgroupAny(own < end); own += gl_WorkGroupSize.x) {
    uint v = min(own, end - 1u);
    uint vertex = vertex_list[v];
    bool on_crease = (vertex & VERTEX_ON_CREASE) != 0u;
    if (!subgroupAny(on_crease)) continue;
    uvec3 cell = cell_in_brick(vertex_cell(vertex));
    vec3 low = corner_position(at.at * BRICK_CELLS + cell);
    float size = origin.w;
    Crossing from0 = Crossing(vec3(0.0), vec3(0.0), false), from1 = from0, from2 = from0;
    if (on_crease) {
      from0 = crossing_of(b, cell, vertex_edge(vertex, 0u));
      from1 = crossing_of(b, cell, vertex_edge(vertex, 1u));
      from2 = crossing_of(b, cell, vertex_edge(vertex, 2u));
    }
    vec3 x = (vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]) - low) / size;
    float first_beyond = (vertex & VERTEX_BY_SURFACE) != 0u ? BEYOND_FACE : BEYOND;
    Planes planes = no_planes();
    vec3 n0 = vec3(0.0), n1 = vec3(0.0), n2 = vec3(0.0);  // the sides' normals, as last evaluated
    // The direction of the crease, the places along it where it leaves the cell on either way, and where a third side
    // ends it.
    vec3 ahead = vec3(0.0);
    float back = 0.0, forth = 0.0, to_end = 0.0;
    bool may_end = false, ends = false;
    // Stage 0 finds the crease, stage 1 its end. One inner loop serves both, so that the kernel holds the tape's code
    // once.
    for (int stage = 0; stage < 2; ++stage) {
      if (stage == 1) {
        ahead = cross(n0, n1);
        float turn2 = dot(ahead, ahead), third = dot(n2, ahead);
        may_end = on_crease && turn2 > 0.03 && third * third < 0.01 * turn2;
        ahead *= inversesqrt(max(turn2, 1e-12));
        vec3 slope = mix(ahead, vec3(1e-6), lessThan(abs(ahead), vec3(1e-6)));
        vec3 to_least = (vec3(MARGIN) - x) / slope, to_most = (vec3(1.0 - MARGIN) - x) / slope;
        vec3 from_most = min(to_least, to_most), to_first = max(to_least, to_most);
        back = max(max(from_most.x, from_most.y), from_most.z);
        forth = min(min(to_first.x, to_first.y), to_first.z);
      }
      int steps = stage == 0 ? 3 * ROUNDS : 3;
      for (int step = 0; step < steps && subgroupAny(stage == 0 ? on_crease : step < 2 ? may_end : ends); ++step) {
        int side = step % 3;
        vec3 at_side = side == 0 ? from0.at : side == 1 ? from1.at : from2.at;
        vec3 facing = side == 0 ? from0.normal : side == 1 ? from1.normal : from2.normal;
        vec3 outwards = at_side - 0.5;
        bool is_first = step < 3;
        vec3 q = mix(x, at_side, is_first ? FIRST_PULL : PULL) +
                 (is_first ? first_beyond : BEYOND) * (outwards - dot(outwards, facing) * facing);
        // The last step looks from close by, because a side may be curved.
        float along = step == 0 ? back : step == 1 ? forth : mix(to_end, to_end > 0.0 ? forth : back, PULL);
        q = stage == 0 ? q : x + along * ahead;
        Field a = evaluate(low + q * size, at.tape_begin, at.tape_count);
        vec3 d = inward() * size * a.d;
        float inverse = inversesqrt(max(dot(d, d), 1e-30));
        vec3 n = -d * inverse;
        float depth = (inward() * a.f - iso) * inverse;
        if (stage == 0) {
          add_plane(planes, n, dot(n, q - x) + depth);
          n0 = side == 0 ? n : n0;
          n1 = side == 1 ? n : n1;
          n2 = side == 2 ? n : n2;
          if (side == 2) {
            x += meeting_point(planes, x, DAMPING);
            planes = no_planes();
          }
        } else {
          float across = dot(n, ahead);
          bool stands_across = may_end && abs(across) > LEAST_ACROSS;
          float found = along + depth / (stands_across ? across : 1.0);
          bool is_end = stands_across && (step == 2 ? ends : abs(depth) > LEAST_CUT) && found > back && found < forth;
          to_end = is_end && (step == 2 || !ends || abs(found) < abs(to_end)) ? found : to_end;
          ends = ends || is_end;
        }
      }
    }
    x += to_end * ahead;
    if (on_crease) {
      vec3 p = low + x * size;
      positions[3u * v] = p.x;
      positions[3u * v + 1u] = p.y;
      positions[3u * v + 2u] = p.z;
    }
  }
}
