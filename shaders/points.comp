// The field at a batch of points: a subgroup takes up to its size of points of one pruned tape. No branch around the
// loads and stores of points: on lavapipe that would make each a loop over the lanes.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

// tape begin, tape count (0: the field is 0), first place in `order`, last (engine/field_evaluator.cpp)
layout(std430, binding = 4) readonly buffer Jobs { uvec4 jobs[]; };
layout(std430, binding = 5) readonly buffer Order { uint order[]; };
layout(std430, binding = 6) readonly buffer Points { float points[]; };

layout(push_constant) uniform Constants {
  uint first_job;
  uint last_job;    // surplus subgroups repeat it
  uint is_ordered;  // 0: places are those of the batch
};

void main() {
  uvec4 job = jobs[min(first_job + gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID, last_job)];
  uint n = min(job.z + gl_SubgroupInvocationID, job.w);  // surplus invocations repeat the last point
  uint place = order[n * is_ordered];
  place = is_ordered != 0u ? place : n;
  vec3 p = vec3(points[3u * place], points[3u * place + 1u], points[3u * place + 2u]);
  write_result(place, select_field(evaluate(p, job.x, job.y), zero_field(), job.y == 0u));
}
