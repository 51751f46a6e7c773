// Mesher, pass 1: the field at the corners of a brick's cells, one workgroup a brick.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "mesh_constants.glsl"

layout(local_size_x = 128) in;

layout(std430, binding = 5) readonly buffer Jobs { uint jobs[]; };  // bricks of this dispatch's kernel
layout(std430, binding = 6) writeonly buffer Samples { float samples[]; };

void main() {
  uvec2 job = uvec2(jobs[2u * (first + gl_WorkGroupID.x)], jobs[2u * (first + gl_WorkGroupID.x) + 1u]);
  Brick b = brick(job.x);
  // Surplus invocations repeat the last corner: no branch around the tape (TAPE_LENGTH).
  uint n = min(gl_LocalInvocationID.x, CORNERS_PER_BRICK - 1u);
  uvec3 offset = uvec3(n % BRICK_CORNERS, n / BRICK_CORNERS % BRICK_CORNERS, n / (BRICK_CORNERS * BRICK_CORNERS));
  uvec3 i = b.at * BRICK_CELLS + offset;
  float f = inward() * evaluate(corner_position(i), b.tape_begin, b.tape_count).f;
  samples[job.y * CORNERS_PER_BRICK + n] = is_cap(i) ? cap_value() : f;
}
