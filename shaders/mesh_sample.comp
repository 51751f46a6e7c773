// Mesher, pass 1: the field at the corners of bricks' cells, or `shift` beside them, eight invocations a part of a brick.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// The brick, and its place in the slab and the part in the lowest four bits: of this dispatch's kernel.
layout(std430, binding = 5) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = 6) writeonly buffer Samples { float samples[]; };

void main() {
  // Surplus invocations repeat the last part: no branch around the tape (TAPE_LENGTH).
  uint at = 2u * (first + min(gl_GlobalInvocationID.x / PART_CORNERS, count - 1u));
  Brick b = brick(jobs[at]);
  uint place = jobs[at + 1u] >> 4u, part = jobs[at + 1u] & 15u;
  uvec3 corner = corner_of_part(part, gl_GlobalInvocationID.x % PART_CORNERS);
  uvec3 i = b.at * BRICK_CELLS + corner;
  float f = inward() * evaluate(corner_position(i) + shift * BESIDE, b.tape_begin, b.tape_count).f;
  samples[place * CORNERS_PER_BRICK + sample_place(corner)] = is_cap(i) ? cap_value() : f;
}
