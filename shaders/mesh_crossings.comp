// Mesher, pass 6: where the surface crosses each quad's edge, and its normal there, one workgroup a brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require

#include "interpreter.glsl"
#include "mesh_constants.glsl"

layout(local_size_x = INVOCATIONS) in;

// brick, place of its samples in the slab
layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_CROSSINGS_SAMPLES) readonly buffer Samples { float samples[]; };
layout(std430, binding = BINDING_MESH_STARTS) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = BINDING_MESH_QUADS) readonly buffer Quads { uvec2 quad_list[]; };
// mesh_crossings.glsl
layout(std430, binding = BINDING_MESH_CROSSINGS) writeonly buffer Crossings { float crossings[]; };

// The linearised distance, in cells, from where a step of Newton's method is the last: it squares it.
const float NEAR = 0.02;
const int STEPS = 8;
// The cosine between an edge's way and a normal below which the edge runs along the surface.
const float ALONG = 0.05;

void main() {
  uint b = jobs[2u * (first + gl_WorkGroupID.x)];
  uint slot = jobs[2u * (first + gl_WorkGroupID.x) + 1u];
  Brick at = brick(b);
  uint end = starts[b + 1u].y;
  // Subgroups go on whole, as mesh_vertices.comp says: surplus invocations repeat the last crossing.
  for (uint own = starts[b].y + gl_LocalInvocationID.x; subgroupAny(own < end); own += gl_WorkGroupSize.x) {
    uint q = min(own, end - 1u);
    uint code = quad_list[q].y;
    uvec3 cell = cell_in_brick(code & 0xffu), step_along = axis_vector(code >> 8u & 3u);
    bool inside_low = (code >> 10u) != 0u;
    float f0 = samples[slot * CORNERS_PER_BRICK + sample_place(cell)];
    float f1 = samples[slot * CORNERS_PER_BRICK + sample_place(cell + step_along)];
    uvec3 base = at.at * BRICK_CELLS + cell;
    // Where its inner end is on the surface the edge may run along it: there it is looked for beside the edge, too.
    float size = origin.w;
    bool begins_on_surface = is_on_surface(inside_low ? f0 : f1);
    vec3 beside = begins_on_surface ? shift * BESIDE : vec3(0.0);
    vec3 low = corner_position(base) + beside, along = vec3(step_along);

    // Newton's method along the edge within a bracket that closes from both sides, and bisection where it would leave
    // it.
    float least = 0.0, most = 1.0;
    float s = clamp((iso - f0) / (f1 - f0), 0.0, 1.0);
    vec3 n = inside_low ? along : -along;
    bool done = is_cap(base + (inside_low ? step_along : uvec3(0u)));
    for (int step = 0; step < STEPS && subgroupAny(!done); ++step) {
      Field a = evaluate(low + s * size * along, at.tape_begin, at.tape_count);
      // Scaled by the cell first: in large units the square of a gradient underflows.
      vec3 d = inward() * size * a.d;
      float excess = inward() * a.f - iso, slope2 = dot(d, d);
      // There the surface that it runs along may be nearer than the one that it crosses.
      bool crosses = !begins_on_surface || abs(dot(d, along)) > ALONG * sqrt(slope2);
      n = slope2 > 1e-30 && !done && crosses ? -d * inversesqrt(slope2) : n;
      if ((excess > 0.0) == inside_low) least = s; else most = s;
      float newton = s - excess / dot(d, along), within = clamp(newton, least, most);
      // Near the surface, and not beside it: the edge may leave it at a small angle. Neither of a NaN.
      bool is_last = abs(excess) <= NEAR * sqrt(slope2) && abs(newton - within) <= NEAR;
      s = done ? s : newton == within || is_last ? within : 0.5 * (least + most);
      done = done || is_last;
    }
    // Back onto the edge along the tangent plane, as far as that crosses it.
    float slope = dot(n, along);
    s = clamp(s + dot(n, beside) / size * slope / (slope * slope + ALONG * ALONG), 0.0, 1.0);
    n *= (begins_on_surface ? 3.0 : 1.0) + s;
    crossings[3u * q] = n.x;
    crossings[3u * q + 1u] = n.y;
    crossings[3u * q + 2u] = n.z;
  }
}
