// Fills the volume of the gradient blend, [G] section 4.3: (g, dg/df1, dg/df2, dg/dtheta) at size^3 nodes over f1 and
// f2 in [0, 1] and theta in [0, pi/4], with f1 varying fastest. SMOOTH selects the smooth silhouette, otherwise it is
// the one whose table starts at 0. FLAT selects the rows with f1 >= 0.5, where the boundary is constant and g needs no
// iteration, otherwise it fills the rows with f1 < 0.5. Each version computes the nodes of its rows with f2 <= f1, and
// mirrors them.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gradient_blend.glsl"

layout(local_size_x = 32) in;

// t = tan(theta) and dt/dtheta for every layer.
layout(std430, binding = BINDING_OPERATOR_VOLUME_ANGLES) readonly buffer Angles { vec2 angles[]; };
layout(std430, binding = BINDING_OPERATOR_VOLUME_NODES) writeonly buffer Nodes { vec4 nodes[]; };

layout(push_constant) uniform Constants {
  uint size;  // a multiple of 4
};

#ifdef SMOOTH
const uint SILHOUETTE = SMOOTH_SILHOUETTE;
#else
const uint SILHOUETTE = 0u;
#endif

// Returns what gradient_blend() returns for hi >= 0.5, where F is linear in C.
vec4 flat_blend(float hi, float lo, float t) {
  float k = 0.5 * t, a = hi - k;
  float w = min((hi - lo) / a, 1.0), u = 1.0 - w;
  vec3 q = silhouette_profile(SILHOUETTE, silhouette_grading(SILHOUETTE), u, w);
  float m_hi = q.x - u * q.y, m_lo = q.y;
  return vec4(hi + a * (q.x - 1.0), m_hi, m_lo, 0.5 * (1.0 - m_hi - m_lo));
}

// A workgroup fills two rows of one layer, a long one and a short one, so that all workgroups have as much to do.
void main() {
  uint rows = size / 2u, pairs = rows / 2u;
  uint pair = gl_WorkGroupID.x % pairs, layer = gl_WorkGroupID.x / pairs;
#ifdef FLAT
  uint first = rows;
#else
  uint first = 0u;
#endif
  vec2 angle = angles[layer];
  float last = float(size - 1u);
  uint nodes_before = layer * size * size;
  uint split = first + pair + 1u, count = 2u * first + rows + 1u;
  for (uint n = gl_LocalInvocationID.x; n < count; n += 32u) {
    bool is_short = n < split;
    uint i = is_short ? first + pair : first + rows - 1u - pair, j = is_short ? n : n - split;
    float hi = float(i) / last, lo = float(j) / last;
#ifdef FLAT
    vec4 v = flat_blend(hi, lo, angle.x);
#else
    Blend b = gradient_blend(hi, lo, angle.x, SILHOUETTE);
    vec4 v = vec4(b.g, b.g1, b.g2, b.gt);
#endif
    v.w *= angle.y;
    nodes[nodes_before + i * size + j] = v.xzyw;
    nodes[nodes_before + j * size + i] = v;
  }
}
