// Mesher, pass 2: the samples that bricks take over from those beside them, eight invocations a part.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) readonly buffer Jobs { uvec4 jobs[]; };  // SampleParts::taken_over
layout(std430, binding = 6) buffer Samples { float samples[]; };

void main() {
  uvec4 job = jobs[min(gl_GlobalInvocationID.x / PART_CORNERS, count - 1u)];
  uint n = gl_GlobalInvocationID.x % PART_CORNERS;
  uvec3 corner = corner_of_part(job.y, n), own = corner % BRICK_CELLS;
  uint from = n < BRICK_CELLS ? job.z : job.w;
  samples[job.x * CORNERS_PER_BRICK + sample_place(corner)] = samples[from * CORNERS_PER_BRICK + sample_place(own)];
}
