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
  uint table;       // of the silhouette, or of the opening
  uint is_opening;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  vec4 a = arguments[i];
  if (is_opening != 0u) {
    results[i] = vec4(opening_tangent(table, a.x), 0.0);
  } else {
    Blend b = gradient_blend(a.x, a.y, a.z, table);
    results[i] = vec4(b.g, b.g1, b.g2, b.gt);
  }
}
