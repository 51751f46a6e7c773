// Mesher, pass 6: finds where the surface crosses each quad's edge, and its normal there. A workgroup takes one brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "interpreter.glsl"
#include "mesh_constants.glsl"

layout(local_size_x = INVOCATIONS) in;

// A brick, and the place of its samples in the slab.
layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_CROSSINGS_SAMPLES) readonly buffer Samples { float samples[]; };
layout(std430, binding = BINDING_MESH_STARTS) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = BINDING_MESH_QUADS) readonly buffer Quads { uvec2 quad_list[]; };
// The crossings, in the form of mesh_crossings.glsl.
layout(std430, binding = BINDING_MESH_CROSSINGS) writeonly buffer Crossings { float crossings[]; };

// The linearised distance, in cells, below which the next step of Newton's method is the last: a step squares the
// distance.
const float NEAR = 0.02;
const int STEPS = 8;
// The edge counts as running along the surface if the cosine between its direction and the normal is below this.
const float ALONG = 0.05;

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  uint slot = jobs[2u * (first + gl_WorkGroupID.x) + 1u];
  Brick at = brick(b);
  uint end = starts[b + 1u].y;
  // All invocations of a subgroup stay in the loop, as mesh_vertices.comp explains: surplus ones repeat the last
  // crossing.
  for (uint own = starts[b].y + gl_LocalInvocationID.x; subgroupAny(own < end); own += gl_WorkGroupSize.x) {
    uint q = min(own, end - 1u);
    uint code = quad_list[q].y;
    uvec3 cell = cell_in_brick(code & 0xffu), step_along = axis_vector(code >> 8u & 3u);
    bool inside_low = (code >> 10u) != 0u;
    float f0 = samples[slot * CORNERS_PER_BRICK + sample_place(cell)];
    float f1 = samples[slot * CORNERS_PER_BRICK + sample_place(cell + step_along)];
    uvec3 base = at.at * BRICK_CELLS + cell;
    // If the inner end of the edge is on the surface, the edge may run along the surface. Then the crossing is looked
    // for beside the edge, as the samples there are.
    float size = origin.w;
    bool begins_on_surface = is_on_surface(inside_low ? f0 : f1);
    vec3 beside = begins_on_surface ? shift * BESIDE : vec3(0.0);
    vec3 low = corner_position(base) + beside, along = vec3(step_along);

    // Newton's method along the edge, within a bracket that closes from both sides; a step that would leave the bracket
    // is replaced by bisection.
    float least = 0.0, most = 1.0;
    float s = clamp((iso - f0) / (f1 - f0), 0.0, 1.0);
    vec3 n = inside_low ? along : -along;
    bool done = is_cap(base + (inside_low ? step_along : uvec3(0u)));
    for (int step = 0; step < STEPS && subgroupAny(!done); ++step) {
      Field a = evaluate(low + s * size * along, at.tape_begin, at.tape_count);
      // The gradient is scaled by the cell first: in large units its square underflows.
      vec3 d = inward() * size * a.d;
      float excess = inward() * a.f - iso, slope2 = dot(d, d);
      // If the edge runs along the surface, that part of the surface may be nearer than the part that the edge crosses.
      bool crosses = !begins_on_surface || abs(dot(d, along)) > ALONG * sqrt(slope2);
      n = slope2 > 1e-30 && !done && crosses ? -d * inversesqrt(slope2) : n;
      if ((excess > 0.0) == inside_low) least = s; else most = s;
      float newton = s - excess / dot(d, along), within = clamp(newton, least, most);
      // The step is the last if it is near the surface and not only beside it, since the edge may leave the surface at
      // a small angle. Both comparisons are false for a NaN.
      bool is_last = abs(excess) <= NEAR * sqrt(slope2) && abs(newton - within) <= NEAR;
      s = done ? s : newton == within || is_last ? within : 0.5 * (least + most);
      done = done || is_last;
    }
    // The crossing is moved back onto the edge along the tangent plane, as far as the plane crosses the edge.
    float slope = dot(n, along);
    s = clamp(s + dot(n, beside) / size * slope / (slope * slope + ALONG * ALONG), 0.0, 1.0);
    n *= (begins_on_surface ? 3.0 : 1.0) + s;
    crossings[3u * q] = n.x;
    crossings[3u * q + 1u] = n.y;
    crossings[3u * q + 2u] = n.z;
  }
}
