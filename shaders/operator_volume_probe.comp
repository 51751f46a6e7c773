// Looks values up in a volume, for tests and benchmarks. EXACT selects the smooth blend itself, for comparison. FIRST
// leaves the second partials out.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "volume.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_VOLUME_PROBE_ARGUMENTS) readonly buffer Arguments { vec4 arguments[]; };  // f1, f2, t
// A row of three vectors: (g, g1, g2, gt), (g11, g12, g22) and (g1t, g2t); with FIRST only the first of them.
layout(std430, binding = BINDING_VOLUME_PROBE_RESULTS) writeonly buffer Results { vec4 results[]; };

layout(push_constant) uniform Constants {
  uint count;
  uint slot;
  uint size;
  uint continues_about_origin;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  vec4 a = arguments[i];
#ifdef EXACT
  Blend b = gradient_blend(a.x, a.y, a.z, SMOOTH_SILHOUETTE);
#else
  Blend b = volume_blend(a.x, a.y, a.z, slot, size, continues_about_origin == 0u);
#endif
#ifdef FIRST
  results[i] = vec4(b.g, b.g1, b.g2, b.gt);
#else
  results[3u * i] = vec4(b.g, b.g1, b.g2, b.gt);
  results[3u * i + 1u] = vec4(b.g11, b.g12, b.g22, 0.0);
  results[3u * i + 2u] = vec4(b.g1t, b.g2t, 0.0, 0.0);
#endif
}
