// Each invocation fetches once from a 3-D texture, at a place of its own. This is the least that the papers' blends
// cost.
#version 450

layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler3D blend;
layout(std430, binding = 1) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 2) writeonly buffer Results { vec4 results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  results[i] = textureLod(blend, places[i].xyz, 0.0);
}
