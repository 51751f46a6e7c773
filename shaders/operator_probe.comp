// The gradient blend and its opening functions at given arguments: what the tests hold against golden values.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gradient_blend.glsl"
#include "profiles.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 4) readonly buffer Arguments { vec4 arguments[]; };  // f1, f2, t; or alpha
layout(std430, binding = 5) writeonly buffer Results { vec4 results[]; };     // g, g1, g2, gt; or t, dt/dalpha

layout(push_constant) uniform Constants {
  uint count;
  uint what;  // 0: the blend with a table at 0; 1: with the smooth silhouette; 2: an opening with a table at 0
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  vec4 a = arguments[i];
  if (what == 2u) {
    results[i] = vec4(opening_tangent(0u, a.x), 0.0);
  } else {
    Blend b;
    if (what == 1u) b = gradient_blend(a.x, a.y, a.z, SMOOTH_SILHOUETTE);
    else b = gradient_blend(a.x, a.y, a.z, 0u);
    results[i] = vec4(b.g, b.g1, b.g2, b.gt);
  }
}
