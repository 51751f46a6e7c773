// Fills the volume of an operator that is given by samples only. Partials are central differences, one-sided at the
// ends.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "bindings.glsl"

layout(local_size_x = 64) in;

// size^3 samples; f1 varies fastest.
layout(std430, binding = BINDING_SAMPLED_VOLUME_SAMPLES) readonly buffer Samples { float samples[]; };
// The nodes of the volume, as in operator_volume.comp.
layout(std430, binding = BINDING_SAMPLED_VOLUME_NODES) writeonly buffer Nodes { vec4 nodes[]; };

layout(push_constant) uniform Constants {
  uint size;
};

const float QUARTER_PI = 0.785398163397448;

float difference(uint at, uint stride, uint place) {
  uint before = place > 0u ? 1u : 0u, after = place + 1u < size ? 1u : 0u;
  return (samples[at + after * stride] - samples[at - before * stride]) * float(size - 1u) / float(before + after);
}

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= size * size * size) return;
  uint i = at % size, j = at / size % size, k = at / (size * size);
  nodes[at] = vec4(samples[at], difference(at, 1u, i), difference(at, size, j),
                   difference(at, size * size, k) / QUARTER_PI);
}
