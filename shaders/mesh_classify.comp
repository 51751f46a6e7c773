// Mesher, pass 3: finds which corners of each cell are inside. An invocation takes four cells.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "mesh_constants.glsl"

layout(local_size_x = 64) in;

// The samples of the slab that starts at brick `first`.
layout(std430, binding = BINDING_MESH_CLASSIFY_SAMPLES) readonly buffer Samples { float samples[]; };
layout(std430, binding = BINDING_MESH_CLASSIFY_CASES) writeonly buffer Cases { uint cases[]; };  // four cells a word
// 1 for a brick with samples near iso.
layout(std430, binding = BINDING_MESH_CLASSIFY_NEAR_BRICKS) writeonly buffer NearBricks { uint near_bricks[]; };

// The bricks of the slab to classify, if the dispatch is listed.
layout(std430, binding = BINDING_MESH_CLASSIFY_LISTED) readonly buffer Listed { uint listed[]; };

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= count * (CELLS_PER_BRICK / 4u)) return;
  uint b = word / (CELLS_PER_BRICK / 4u);
  if (is_listed()) b = listed[b];
  uint packed_cases = 0u;
  float nearest = 1e30;
  for (uint n = 0u; n < 4u; ++n) {
    uvec3 cell = cell_in_brick(word % (CELLS_PER_BRICK / 4u) * 4u + n);
    uint inside = 0u;
    for (uint corner = 0u; corner < 8u; ++corner) {
      float f = samples[b * CORNERS_PER_BRICK + sample_place(cell + corner_offset(corner))];
      inside |= (f > iso ? 1u : 0u) << corner;
      nearest = min(nearest, abs(f - iso));
    }
    packed_cases |= inside << (8u * n);
  }
  cases[(first + b) * (CELLS_PER_BRICK / 4u) + word % (CELLS_PER_BRICK / 4u)] = packed_cases;
  if (nearest <= near) near_bricks[b] = 1u;
}
