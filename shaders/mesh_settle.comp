// Mesher, pass 3c: puts the samples that are on the surface on the side of the point beside them, eight invocations an
// octet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// a place in `listed` times OCTETS + octet
layout(std430, binding = BINDING_MESH_SETTLE_OCTETS) readonly buffer Octets { uint octets[]; };
layout(std430, binding = BINDING_MESH_SETTLE_SAMPLES) buffer Samples { float samples[]; };
// by places in `listed`
layout(std430, binding = BINDING_MESH_SETTLE_BESIDE) readonly buffer Beside { float samples_beside[]; };
// bricks' places in the slab
layout(std430, binding = BINDING_MESH_SETTLE_LISTED) readonly buffer Listed { uint listed[]; };

void main() {
  uint at = octets[min(gl_GlobalInvocationID.x / OCTET_CORNERS, count - 1u)];
  uvec3 corner = corner_of_octet(at & (OCTETS - 1u), gl_GlobalInvocationID.x % OCTET_CORNERS);
  uint i = listed[at >> OCTET_BITS] * CORNERS_PER_BRICK + sample_place(corner);
  float excess = samples[i] - iso;
  float excess_beside = samples_beside[(at >> OCTET_BITS) * CORNERS_PER_BRICK + sample_place(corner)] - iso;
  // How much the field changes from one point to the other tells its slope, so that in all bricks that know the sample
  // the same is decided.
  bool is_near = abs(excess) <= min(near, value_room + slope_room * abs(excess_beside - excess));
  if (is_near) samples[i] = excess_beside > 0.0 ? just_inside : iso;
}
