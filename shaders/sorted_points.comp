// Evaluates the field at points that are sorted by their pruned tapes. A subgroup takes points of one tape, at most as
// many as it has invocations. No branch surrounds the loads and stores of points, because on lavapipe that would make
// each of them a loop over the lanes.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

// A job: the tape's begin, its count (0 if the field is 0), the first point and the last
// (engine/points/field_evaluator.cpp).
layout(std430, binding = BINDING_SORTED_POINTS_JOBS) readonly buffer Jobs { uvec4 jobs[]; };
// The points, with the bits of their places in the batch in w. They are stored in the sorted order, because reading
// them in the order of the batch would access memory at places far from each other.
layout(std430, binding = BINDING_SORTED_POINTS_POINTS) readonly buffer Points { vec4 points[]; };

layout(push_constant) uniform Constants {
  uint first_job;
  uint last_job;    // surplus subgroups repeat it
  uint size_shift;  // log2 of the subgroup's size; a shift, because on lavapipe each lane would divide by itself
};

void main() {
  uvec4 job = jobs[min(first_job + (gl_GlobalInvocationID.x >> size_shift), last_job)];
  uint lane = gl_GlobalInvocationID.x & (1u << size_shift) - 1u;
  vec4 point = points[min(job.z + lane, job.w)];  // surplus invocations repeat the last point
  Field a = evaluate(point.xyz, job.x, job.y);
  write_result(floatBitsToUint(point.w), select_field(a, zero_field(), job.y == 0u));
}
