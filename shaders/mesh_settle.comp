// Mesher, pass 3c: puts the samples that are on the surface on the side of the point beside them, eight invocations a
// part of a brick.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) readonly buffer Parts { uint parts[]; };  // a place in near_bricks, the part in bits 0-3
layout(std430, binding = 6) buffer Samples { float samples[]; };
layout(std430, binding = 7) readonly buffer Beside { float samples_beside[]; };  // by places in near_bricks
layout(std430, binding = 8) readonly buffer NearBricks { uint near_bricks[]; };          // their places in the slab

void main() {
  uint part = parts[min(gl_GlobalInvocationID.x / PART_CORNERS, count - 1u)];
  uvec3 corner = corner_of_part(part & 15u, gl_GlobalInvocationID.x % PART_CORNERS);
  uint i = near_bricks[part >> 4u] * CORNERS_PER_BRICK + sample_place(corner);
  float excess = samples[i] - iso;
  float excess_beside = samples_beside[(part >> 4u) * CORNERS_PER_BRICK + sample_place(corner)] - iso;
  // How much the field changes from one point to the other tells its slope, so that in all bricks that know the sample
  // the same is decided.
  bool is_near = abs(excess) <= min(near, value_room + slope_room * abs(excess_beside - excess));
  if (is_near) samples[i] = excess_beside > 0.0 ? just_inside : iso;
}
