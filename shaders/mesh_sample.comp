// Mesher, pass 1: evaluates the field at the corners of bricks' cells, or at the distance `shift` beside them. Eight
// invocations take one octet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "interpreter.glsl"
#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// A job: the brick, and its place in the slab times OCTETS plus the octet.
layout(std430, binding = BINDING_MESH_JOBS) readonly buffer Jobs { uint jobs[]; };
layout(std430, binding = BINDING_MESH_SAMPLE_SAMPLES) writeonly buffer Samples { float samples[]; };

void main() {
  // Surplus invocations repeat the last octet, so that no branch surrounds the tape's evaluation (TAPE_LENGTH).
  uint at = 2u * (first + min(gl_GlobalInvocationID.x / OCTET_CORNERS, count - 1u));
  Brick b = brick(jobs[at]);
  uint place = jobs[at + 1u] >> OCTET_BITS, octet = jobs[at + 1u] & (OCTETS - 1u);
  uvec3 corner = corner_of_octet(octet, gl_GlobalInvocationID.x % OCTET_CORNERS);
  uvec3 i = b.at * BRICK_CELLS + corner;
  float f = inward() * evaluate(corner_position(i) + shift * BESIDE, b.tape_begin, b.tape_count).f;
  samples[place * CORNERS_PER_BRICK + sample_place(corner)] = is_cap(i) ? cap_value() : f;
}
