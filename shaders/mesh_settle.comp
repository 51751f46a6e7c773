// Mesher, pass 3c: gives samples that are on the surface the side of the point beside them. Eight invocations take one
// octet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// A place in `listed` times OCTETS plus the octet.
layout(std430, binding = BINDING_MESH_SETTLE_OCTETS) readonly buffer Octets { uint octets[]; };
layout(std430, binding = BINDING_MESH_SETTLE_SAMPLES) buffer Samples { float samples[]; };
// The samples at the points beside the corners, by places in `listed`.
layout(std430, binding = BINDING_MESH_SETTLE_BESIDE) readonly buffer Beside { float samples_beside[]; };
// The places in the slab of the bricks to settle.
layout(std430, binding = BINDING_MESH_SETTLE_LISTED) readonly buffer Listed { uint listed[]; };

void main() {
  uint at = octets[min(gl_GlobalInvocationID.x / OCTET_CORNERS, count - 1u)];
  uvec3 corner = corner_of_octet(at & (OCTETS - 1u), gl_GlobalInvocationID.x % OCTET_CORNERS);
  uint i = listed[at >> OCTET_BITS] * CORNERS_PER_BRICK + sample_place(corner);
  float excess = samples[i] - iso;
  float excess_beside = samples_beside[(at >> OCTET_BITS) * CORNERS_PER_BRICK + sample_place(corner)] - iso;
  // The slope is estimated from how much the field changes from one point to the other, so that all bricks that share
  // the sample decide the same.
  bool is_near = abs(excess) <= min(near, value_room + slope_room * abs(excess_beside - excess));
  if (is_near) samples[i] = excess_beside > 0.0 ? just_inside : iso;
}
