// The field at points that are sorted by their pruned tapes: a subgroup takes up to its size of those of one tape. No
// branch around the loads and stores of points: on lavapipe that would make each a loop over the lanes.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

// tape begin, tape count (0: the field is 0), first point, last (engine/points/field_evaluator.cpp)
layout(std430, binding = BINDING_SORTED_POINTS_JOBS) readonly buffer Jobs { uvec4 jobs[]; };
// With their places in the batch as bits: read together, where points in another order are far from each other.
layout(std430, binding = BINDING_SORTED_POINTS_POINTS) readonly buffer Points { vec4 points[]; };

layout(push_constant) uniform Constants {
  uint first_job;
  uint last_job;    // surplus subgroups repeat it
  uint size_shift;  // log2 of the subgroup's size: on lavapipe a division is one for each lane
};

void main() {
  uvec4 job = jobs[min(first_job + (gl_GlobalInvocationID.x >> size_shift), last_job)];
  uint lane = gl_GlobalInvocationID.x & (1u << size_shift) - 1u;
  vec4 point = points[min(job.z + lane, job.w)];  // surplus invocations repeat the last point
  Field a = evaluate(point.xyz, job.x, job.y);
  write_result(floatBitsToUint(point.w), select_field(a, zero_field(), job.y == 0u));
}
