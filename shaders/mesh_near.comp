// Mesher, pass 3b: finds which octets hold samples that may be on the surface. An invocation takes one octet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// The places in the slab of the bricks to check.
layout(std430, binding = BINDING_MESH_NEAR_LISTED) readonly buffer Listed { uint listed[]; };
layout(std430, binding = BINDING_MESH_NEAR_SAMPLES) readonly buffer Samples { float samples[]; };
// OCTETS entries for each brick: 1 for an octet with samples near iso, else 0.
layout(std430, binding = BINDING_MESH_NEAR_NEAR_OCTETS) writeonly buffer NearOctets { uint near_octets[]; };

void main() {
  uint n = gl_GlobalInvocationID.x;
  if (n >= count * OCTETS) return;
  float nearest = 1e30;
  for (uint i = 0u; i < OCTET_CORNERS; ++i) {
    uvec3 corner = corner_of_octet(n % OCTETS, i);
    float f = samples[listed[n / OCTETS] * CORNERS_PER_BRICK + sample_place(corner)];
    nearest = min(nearest, abs(f - iso));
  }
  near_octets[n] = nearest <= near ? 1u : 0u;
}
