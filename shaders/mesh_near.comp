// Mesher, pass 3b: which parts of bricks hold samples that may be on the surface, an invocation a part.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) readonly buffer NearBricks { uint near_bricks[]; };  // their places in the slab
layout(std430, binding = 6) readonly buffer Samples { float samples[]; };
layout(std430, binding = 7) writeonly buffer NearParts { uint near_parts[]; };  // SAMPLE_PARTS a brick: 0 or 1

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= count * SAMPLE_PARTS) return;
  float nearest = 1e30;
  for (uint i = 0u; i < PART_CORNERS; ++i) {
    uvec3 corner = corner_of_part(n % SAMPLE_PARTS, i);
    float f = samples[near_bricks[n / SAMPLE_PARTS] * CORNERS_PER_BRICK + sample_place(corner)];
    nearest = min(nearest, abs(f - iso));
  }
  near_parts[n] = nearest <= near ? 1u : 0u;
}
