// Mesher, pass 2: copies the samples that bricks share from the neighbours that own them. Eight invocations take one
// octet.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_samples.glsl"

layout(local_size_x = 64) in;

// The jobs, in the form of SlabOctets::taken_over.
layout(std430, binding = BINDING_MESH_SHARE_OCTETS) readonly buffer Octets { uvec4 octets[]; };
layout(std430, binding = BINDING_MESH_SHARE_SAMPLES) buffer Samples { float samples[]; };

void main() {
  uvec4 job = octets[min(gl_GlobalInvocationID.x / OCTET_CORNERS, count - 1u)];
  uint n = gl_GlobalInvocationID.x % OCTET_CORNERS;
  uvec3 corner = corner_of_octet(job.y, n), own = corner % BRICK_CELLS;
  uint from = n < BRICK_CELLS ? job.z : job.w;
  samples[job.x * CORNERS_PER_BRICK + sample_place(corner)] = samples[from * CORNERS_PER_BRICK + sample_place(own)];
}
