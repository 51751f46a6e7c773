// The field at a batch of points: a subgroup takes up to its size of points of one pruned tape. No branch around the
// loads and stores of points: on lavapipe that would make each a loop over the lanes.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

// tape begin, tape count (0: the field is 0), first point, last (engine/field_evaluator.cpp)
layout(std430, binding = 4) readonly buffer Jobs { uvec4 jobs[]; };
// With their places in the batch as bits: read together, where points in another order are far from each other.
layout(std430, binding = 5) readonly buffer Sorted { vec4 sorted[]; };
layout(std430, binding = 6) readonly buffer Points { float points[]; };

layout(push_constant) uniform Constants {
  uint first_job;
  uint last_job;    // surplus subgroups repeat it
  uint is_sorted;   // 0: points are those of the batch
  uint job_points;  // the subgroup's size
};

void main() {
  uvec4 job = jobs[min(first_job + gl_GlobalInvocationID.x / job_points, last_job)];
  uint n = min(job.z + gl_GlobalInvocationID.x % job_points, job.w);  // surplus invocations repeat the last point
  vec4 placed = sorted[is_sorted != 0u ? n : 0u];
  uint at = is_sorted != 0u ? 0u : 3u * n;
  vec3 p = vec3(points[at], points[at + 1u], points[at + 2u]);
  uint place = is_sorted != 0u ? floatBitsToUint(placed.w) : n;
  p = is_sorted != 0u ? placed.xyz : p;
  write_result(place, select_field(evaluate(p, job.x, job.y), zero_field(), job.y == 0u));
}
