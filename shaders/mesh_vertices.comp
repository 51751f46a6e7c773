// Mesher, pass 5: puts every vertex on the surface, one workgroup a brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "interpreter.glsl"
#include "mesh_constants.glsl"

layout(local_size_x = 32) in;

layout(std430, binding = 5) readonly buffer Jobs { uint jobs[]; };  // brick, place of its samples in the slab
layout(std430, binding = 6) readonly buffer Samples { float samples[]; };
layout(std430, binding = 7) readonly buffer SurfaceCases { uvec4 surface_cases[]; };
layout(std430, binding = 8) readonly buffer Cells { uint cells_in[]; };
layout(std430, binding = 9) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 10) readonly buffer Vertices { uint vertex_list[]; };
layout(std430, binding = 11) writeonly buffer Positions { float positions[]; };

// A vertex is done when the linearised distance is below this part of a cell; 1 % is promised.
const float TOLERANCE = 1e-3;
const int NEWTON_STEPS = 5;
const int BISECTION_STEPS = 14;
// Vertices keep off the faces of their cell by this part of it, so that no two coincide.
const float MARGIN = 2e-3;

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  uint slot = jobs[2u * (first + gl_WorkGroupID.x) + 1u];
  Brick at = brick(b);
  uint end = starts[b + 1u].x;
  // By subgroups, whole ones: surplus invocations repeat the last vertex.
  for (uint from = starts[b].x + gl_SubgroupID * gl_SubgroupSize; from < end; from += gl_WorkGroupSize.x) {
    uint v = min(from + gl_SubgroupInvocationID, end - 1u);
    uint cell_number = vertex_list[v] & 0xffu, patch_number = vertex_list[v] >> 8u;
    uvec3 cell = cell_in_brick(cell_number);
    uint state = cell_case(cells_in[b * CELLS_PER_BRICK + cell_number]);
    uint edges = case_edges(surface_cases[state], patch_number);

    // The mean of the patch's crossings, in cells, and one corner of it on either side.
    vec3 sum = vec3(0.0);
    float crossings = 0.0;
    uvec3 inside_corner = uvec3(0u), outside_corner = uvec3(0u);
    bool is_cap = false;
    for (uint edge = 0u; edge < 12u; ++edge) {
      if ((edges >> edge & 1u) != 0u) {
        uvec3 low = edge_offset(edge), high = low + axis_vector(edge >> 2u);
        float f0 = samples[slot * CORNERS_PER_BRICK + sample_place(cell + low)];
        float f1 = samples[slot * CORNERS_PER_BRICK + sample_place(cell + high)];
        float s = clamp((iso - f0) / (f1 - f0), 0.0, 1.0);
        sum += mix(vec3(low), vec3(high), s);
        crossings += 1.0;
        inside_corner = f0 > iso ? low : high;
        outside_corner = f0 > iso ? high : low;
        uvec3 outer = at.at * BRICK_CELLS + cell + outside_corner;
        is_cap = is_cap || (is_capped() && (any(equal(outer, uvec3(0u))) || any(greaterThanEqual(outer, cells.xyz))));
      }
    }
    uvec3 base = at.at * BRICK_CELLS + cell;
    vec3 low = corner_position(base);
    float size = origin.w;
    vec3 least = low + vec3(MARGIN * size), most = low + vec3((1.0 - MARGIN) * size);
    vec3 p = clamp(low + sum / max(crossings, 1.0) * size, least, most);

    // Newton's method along the gradient within the cell; where that does not settle, bisection between the last point
    // and a corner of the other side.
    vec3 inner = clamp(corner_position(base + inside_corner), least, most);
    vec3 outer = clamp(corner_position(base + outside_corner), least, most);
    bool done = is_cap;
    for (int step = 0; step < NEWTON_STEPS + BISECTION_STEPS && subgroupAny(!done); ++step) {
      Field a = evaluate(p, at.tape_begin, at.tape_count);
      a.d *= inward();
      float excess = inward() * a.f - iso;
      float slope2 = dot(a.d, a.d);
      done = done || abs(excess) <= TOLERANCE * size * sqrt(slope2);
      vec3 move = -excess / max(slope2, 1e-30) * a.d;
      float far = max(max(abs(move.x), abs(move.y)), abs(move.z));
      move *= far > size ? size / far : 1.0;
      vec3 newton = clamp(p + move, least, most);
      if (excess > 0.0) inner = p; else outer = p;
      if (step == NEWTON_STEPS - 1) {
        // Keep the side that p is on, and start from the patch's own corner on the other.
        if (excess > 0.0) outer = clamp(corner_position(base + outside_corner), least, most);
        else inner = clamp(corner_position(base + inside_corner), least, most);
      }
      vec3 next = step < NEWTON_STEPS - 1 ? newton : 0.5 * (inner + outer);
      p = done ? p : next;
    }
    positions[3u * v] = p.x;
    positions[3u * v + 1u] = p.y;
    positions[3u * v + 2u] = p.z;
  }
}
