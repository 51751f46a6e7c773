// The field at a batch of points: a workgroup takes up to POINTS_PER_GROUP points of one pruned tape.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "output.glsl"

layout(local_size_x = 64) in;

// tape begin, tape count, first place in `order`, points (engine/field_evaluator.cpp)
layout(std430, binding = 4) readonly buffer Jobs { uvec4 jobs[]; };
layout(std430, binding = 5) readonly buffer Order { uint order[]; };
layout(std430, binding = 6) readonly buffer Points { float points[]; };

layout(push_constant) uniform Constants {
  uint first_job;
  uint is_ordered;  // 0: places are those of the batch
};

void main() {
  uvec4 job = jobs[first_job + gl_WorkGroupID.x];
  for (uint first = 0u; first < job.w; first += gl_WorkGroupSize.x) {
    uint n = min(first + gl_LocalInvocationID.x, job.w - 1u);  // surplus invocations repeat the last point
    uint place = is_ordered != 0u ? order[job.z + n] : job.z + n;
    vec3 p = vec3(points[3u * place], points[3u * place + 1u], points[3u * place + 2u]);
    Field a = evaluate(p, job.x, job.y);
    if (first + gl_LocalInvocationID.x < job.w) write_result(place, a);
  }
}
